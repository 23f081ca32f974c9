// What the header of an object may cost, at its limits.
#include "header_cost.h"

#include <gmock/gmock.h>

namespace vicon::ingest {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// What is said of the last of so many elements in one item, each tag `step` after the one before.
std::string ofElements(std::size_t count, int step)
{
    HeaderCost cost;
    ItemTally item;
    std::string said;
    std::uint32_t tag = 0x7fffffff;
    for (std::size_t n = 0; n < count && said.empty(); ++n, tag += std::uint32_t(step))
        said = cost.addElement(item, tag, 0);
    return said;
}

TEST(HeaderCost, AnItemHoldsTenThousandElementsAndNoMore)
{
    EXPECT_THAT(ofElements(kMostElementsOfItem, 1), IsEmpty());
    EXPECT_THAT(ofElements(kMostElementsOfItem + 1, 1), HasSubstr("more than 10000 elements"));
}

TEST(HeaderCost, OnlyElementsOutOfTheOrderOfTheirTagsCostSteps)
{
    // One that is wrong is put past all before it: 2 + 3 + ... + n steps.
    constexpr std::size_t kWithin = 4471;
    static_assert(kWithin * (kWithin + 1) / 2 - 1 <= kMostStepsBack);
    static_assert((kWithin + 1) * (kWithin + 2) / 2 - 1 > kMostStepsBack);
    for (const int step : {-1, 0}) {
        EXPECT_THAT(ofElements(kWithin, step), IsEmpty()) << step;
        EXPECT_THAT(ofElements(kWithin + 1, step), HasSubstr("not in the order of their tags")) << step;
    }
}

TEST(HeaderCost, AfterAnElementOutOfOrderTheHighestTagStillCounts)
{
    HeaderCost cost;
    ItemTally item;
    for (const std::uint32_t tag : {5U, 3U, 4U})
        EXPECT_THAT(cost.addElement(item, tag, 0), IsEmpty());
    EXPECT_EQ(item.highest_tag, 5U);
    EXPECT_EQ(item.elements, 3U);
}

TEST(HeaderCost, WhereTheOrderIsNotKnownTheWorstIsAssumed)
{
    HeaderCost cost;
    ItemTally item;
    std::string said;
    std::size_t count = 0;
    while (said.empty()) {
        said = cost.addElement(item, std::nullopt, 0);
        ++count;
    }
    EXPECT_THAT(said, HasSubstr("too many elements to be sorted"));
    EXPECT_EQ(count, 4472U) << "1 + 2 + ... + n steps";
}

TEST(HeaderCost, ValuesAddUpToALimitOfBytes)
{
    HeaderCost cost;
    ItemTally item;
    EXPECT_THAT(cost.addElement(item, 1, kMostHeaderBytes - 1), IsEmpty());
    EXPECT_THAT(cost.addElement(item, 2, 1), IsEmpty()) << "just as much as may be";
    EXPECT_THAT(cost.addElement(item, 3, 1), HasSubstr("more than 128 MB"));
}

TEST(HeaderCost, ElementsItemsAndFragmentsOfAllItemsAddUp)
{
    HeaderCost cost;
    std::string said;
    for (std::size_t n = 0; n < kMostElements - 1 && said.empty(); ++n)
        said = cost.addPart();
    EXPECT_THAT(said, IsEmpty());
    ItemTally item, another;
    EXPECT_THAT(cost.addElement(item, 1, 0), IsEmpty()) << "just as many as may be";
    EXPECT_THAT(cost.addElement(another, 1, 0), HasSubstr("more than 500000 elements"));
}

}  // namespace
}  // namespace vicon::ingest
