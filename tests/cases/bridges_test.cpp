#include "vicon/cases/bridges.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "case_fixture.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon {
namespace {

class BridgesOfAScan : public testing::Test {
protected:
    BridgesOfAScan()
    {
        const Bridge first{{1, 2, 3}, {4, 5, 6}, {}, 12, 0.75, "a short gap", true};
        const Bridge second{{11, 2, 3}, {14, 5, 6}, {}, 80, 0.25, "the gap is long", false};
        one_.record("segment", {{"verdict", "colon"}, {"bridges", {toJson(first), toJson(second)}}});
    }

    std::vector<ReviewedBridge> bridges() { return reviewedBridges(one_.store, one_.scan); }
    nlohmann::json file() const
    {
        return nlohmann::json::parse(readFile(one_.scanFolder() / "bridge_reviews.json"))["bridges"];
    }

    test::StoreOfOneScan one_;
};

TEST_F(BridgesOfAScan, AreThoseOfItsSegmentationUnjudgedAtFirst)
{
    ASSERT_EQ(bridges().size(), 2u);
    EXPECT_EQ(bridges()[1].bridge.length_mm, 80);
    EXPECT_EQ(bridges()[1].bridge.reason, "the gap is long");
    EXPECT_FALSE(bridges()[1].bridge.certain);
    EXPECT_FALSE(bridges()[0].review || bridges()[1].review);
}

TEST_F(BridgesOfAScan, KeepWhoJudgedThemAndWhenInPlaceOfAnEarlierVerdict)
{
    ReviewedBridge judged = bridges()[1];
    judged.review = {BridgeVerdict::confirmed, {}, {}};
    reviewBridge(one_.store, one_.scan, judged);
    ASSERT_TRUE(bridges()[1].review);
    EXPECT_EQ(bridges()[1].review->verdict, BridgeVerdict::confirmed);
    EXPECT_FALSE(bridges()[1].review->by.empty());
    EXPECT_FALSE(bridges()[1].review->at.empty());
    EXPECT_FALSE(bridges()[0].review);

    judged.review = {BridgeVerdict::rejected, "anna", "2026-01-03T00:00:00Z"};
    reviewBridge(one_.store, one_.scan, judged);
    EXPECT_EQ(bridges()[1].review, judged.review);
    ASSERT_EQ(file().size(), 1u);
    EXPECT_EQ(file()[0], nlohmann::json::parse(R"({"from_mm": [11, 2, 3], "to_mm": [14, 5, 6], "verdict": "rejected",
                                                  "by": "anna", "at": "2026-01-03T00:00:00Z"})"));
    judged.review.reset();
    reviewBridge(one_.store, one_.scan, judged);
    EXPECT_FALSE(bridges()[1].review);
    EXPECT_TRUE(file().empty());
}

TEST_F(BridgesOfAScan, JudgedByTwoReadersAtOnceKeepBothVerdicts)
{
    const auto judge = [&](ReviewedBridge bridge) {
        CaseStore own(one_.store.place());
        for (int n = 0; n < 20; ++n) {
            bridge.review = {n % 2 ? BridgeVerdict::confirmed : BridgeVerdict::rejected, std::to_string(n), {}};
            reviewBridge(own, one_.scan, bridge);
            const auto now = reviewedBridges(own, one_.scan);
            EXPECT_TRUE(std::any_of(now.begin(), now.end(), [&](const ReviewedBridge& other) {
                return isSameBridge(other.bridge, bridge.bridge) && other.review &&
                       other.review->by == bridge.review->by;
            }));
        }
    };
    const std::vector<ReviewedBridge> both = bridges();
    std::thread other([&] { judge(both[0]); });
    judge(both[1]);
    other.join();
}

TEST_F(BridgesOfAScan, AreKnownByTheirEndsWithinHalfAMillimetre)
{
    ReviewedBridge judged = bridges()[0];
    judged.review = {BridgeVerdict::confirmed, "anna", "2026-01-03T00:00:00Z"};
    judged.bridge.to_mm.x += 0.4;
    reviewBridge(one_.store, one_.scan, judged);
    EXPECT_TRUE(bridges()[0].review);
    judged.bridge.to_mm.x += 0.4;
    EXPECT_THROW(reviewBridge(one_.store, one_.scan, judged), Error);
}

TEST_F(BridgesOfAScan, SayWhatIsWrongWithTheirFile)
{
    for (const char* text :
         {"{", "[]", R"({"bridges": {}})", R"({"bridges": [{"from_mm": [1, 2, 3]}]})",
          R"({"bridges": [{"from_mm": [1,2,3], "to_mm": [1,2,3], "verdict": "maybe", "by": "", "at": ""}]})"}) {
        std::ofstream(one_.scanFolder() / "bridge_reviews.json") << text;
        try {
            bridges();
            FAIL() << text;
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), ErrorCode::bad_input) << text;
            EXPECT_NE(e.subject().find("bridge_reviews.json"), std::string::npos) << text;
        }
    }
}

}  // namespace
}  // namespace vicon
