// What this room writes, by the schemas of docs/dev/schemas.
#include <gtest/gtest.h>

#include <fstream>

#include "case_fixture.h"
#include "finding_fixture.h"
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

TEST(Schemas, HoldForReports)
{
    test::MarkedCase marked;
    const auto file = marked.scanFolder() / "report.json";
    const auto write = [&](const std::optional<ReportVersion>& version) {
        std::ofstream(file) << reportDocument(version, reportContent(readCase(marked.store, "c1")));
    };
    write({});
    EXPECT_EQ(schemaFaults("report", {file}), "") << "of nothing";
    Marker all = test::markerWithEverything();
    all.id = "m1";
    marked.store.saveMarker("c1", all);
    const Finding finding{.markers = {"m1", "m2"},
                          .morphology = Morphology::flat,
                          .attenuation = Attenuation::mixed,
                          .confidence = Confidence::high,
                          .read_size_mm = 8,
                          .height_mm = 2,
                          .volume_ml = 0.2,
                          .pictures = {"m1"},
                          .note = "n"};
    editFindings(marked.store, "c1", {{std::nullopt, finding}});
    Assessment said;
    said.preparation = said.tagging = Grade::fair;
    said.distension = {{"s1", ColonPart::sigmoid, Distension::limited}};
    said.dose_mgy_cm = said.reading_minutes = said.coverage_percent = 9;
    said.extracolonic = {{"liver", "a cyst", ExtracolonicCategory::e1}};
    saveAssessment(marked.store, "c1", {}, said);
    marked.choose();
    write(keepVersion(marked.store, "c1", draftVersion(marked.store, {}, "c1", false, "0.1.0"), "a PDF"));
    EXPECT_EQ(schemaFaults("report", {file}), "") << "of everything";
    ReadCase other = readCase(marked.store, "c1");
    other.given_lumens["s1"] = {"NIfTI", std::string(64, 'a'), 7, 0.97, "anna", "2026-11-25T12:00:00Z"};
    std::ofstream(file) << reportDocument({}, reportContent(other));
    EXPECT_EQ(schemaFaults("report", {file}), "") << "of a lumen that another program made";
    write({});
    auto wrong = nlohmann::json::parse(readFile(file));
    wrong["content"]["findings"][0]["facts"]["sights"][0]["clock_hour"] = 13;
    std::ofstream(file) << wrong;
    EXPECT_NE(schemaFaults("report", {file}), "") << "it sees what is wrong";
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
