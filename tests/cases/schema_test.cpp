// What this room writes, by the schemas of docs/dev/schemas.
#include <gtest/gtest.h>

#include <fstream>

#include "case_fixture.h"
#include "marker_samples.h"
#include "vicon/cases/bridges.h"
#include "vicon/cases/corrections.h"
#include "vicon/cases/marker.h"
#include "vicon/cases/step_results.h"
#include "vicon/cases/worklist.h"

namespace vicon {
namespace {

using support::schemaFaults;

TEST(Schemas, HoldForMarkersWithEverythingAndWithNothing)
{
    test::StoreOfOneScan one;
    Marker all = test::markerWithEverything();
    all.id.clear();  // both get numbers of their own
    all.extra["of_another_program"] = {1, 2, 3};
    one.store.saveMarker("c1", all);
    one.store.saveMarker("c1", {.scan_id = "s1"});
    const auto file = one.scanFolder() / "markers.json";
    EXPECT_EQ(schemaFaults("markers", {file, one.store.caseFolder("c1") / "markers.json"}), "");
    auto wrong = nlohmann::json::parse(readFile(file));
    for (auto& marker : wrong["markers"])
        if (marker.contains("size"))
            marker["size"].erase("from_mm");
    std::ofstream(file) << wrong;
    EXPECT_NE(schemaFaults("markers", {file}), "") << "it sees what is wrong";
}

TEST(Schemas, HoldForCorrections)
{
    test::StoreOfOneScan one;
    replaceCorrections(one.store, {}, one.scan, {.add = {{1, 2, 3}}, .cut = {{4, 5, 6}, {7, 8, 9}}});
    EXPECT_EQ(schemaFaults("corrections", {one.scanFolder() / "corrections.json"}), "");
}

TEST(Schemas, HoldForBridgesAndTheirReviews)
{
    test::StoreOfOneScan one;
    const Bridge bridge{{1, 2, 3}, {4, 5, 6}, {}, 12, 0.75, "a short gap", true};
    one.record("segment", toJson(SegmentFound{
                              .organ_title = "colon",
                              .bridges = {bridge},
                              .plan = {{"pieces", nlohmann::json::array()}, {"bridges", nlohmann::json::array()}}}));
    reviewBridge(one.store, one.scan, {bridge, BridgeReview{BridgeVerdict::rejected, {}, {}}});
    EXPECT_EQ(schemaFaults("bridge_reviews", {one.scanFolder() / "bridge_reviews.json"}), "");
}

TEST(Schemas, HoldForTheWorklist)
{
    test::StoreOfOneScan one;
    const auto file = one.scanFolder() / "cases.json";
    std::ofstream(file) << toJson(makeWorklist(one.store, {}));
    EXPECT_EQ(schemaFaults("cases", {file}), "");
}

}  // namespace
}  // namespace vicon
