#include "vicon/core/json_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace vicon {
namespace {

using nlohmann::json;

TEST(JsonText, WholeNumbersFitAnInt)
{
    EXPECT_EQ(wholeNumber(json(-7)), -7);
    EXPECT_EQ(wholeNumber(json(3.9)), 3) << "as JSON's own conversion";
    EXPECT_EQ(wholeNumber(json(std::numeric_limits<int>::max())), std::numeric_limits<int>::max());
    for (const json& bad :
         {json(8e60), json(-8e60), json(3e9), json(std::nan("")), json("7"), json(nullptr), json::array()})
        EXPECT_THROW(wholeNumber(bad), json::exception) << bad;
    EXPECT_EQ(wholeNumber(json{{"a", 5}}, "a", 2), 5);
    EXPECT_EQ(wholeNumber(json{{"a", 5}}, "b", 2), 2);
    EXPECT_THROW(wholeNumber(json{{"a", 1e10}}, "a", 2), json::exception);
}

TEST(JsonText, CountsAreNeverNegativeNorBeyondCounting)
{
    EXPECT_EQ(wholeCount(json(0)), 0U);
    EXPECT_EQ(wholeCount(json(5'000'000'000U)), 5'000'000'000U);
    for (const json& bad : {json(-1), json(-0.5), json(8e60), json(std::nan("")), json("7"), json(true)})
        EXPECT_THROW(wholeCount(bad), json::exception) << bad;
}

TEST(JsonText, TooDeepIsNone)
{
    const auto nested = [](int levels) {
        return std::string(std::size_t(levels), '[') + std::string(std::size_t(levels), ']');
    };
    EXPECT_FALSE(parsedJson(nested(kDeepestJson)).is_discarded());
    EXPECT_TRUE(parsedJson(nested(kDeepestJson + 1)).is_discarded());
    EXPECT_TRUE(parsedJson("{").is_discarded());
}

}  // namespace
}  // namespace vicon
