#include "vicon/cases/worklist.h"

#include <gtest/gtest.h>

#include "case_fixture.h"
#include "vicon/cases/corrections.h"
#include "vicon/cases/report_files.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/scan_quality.h"

namespace vicon {
namespace {

class Worklist : public testing::Test {
protected:
    test::StoreOfOneScan one_;

    WorklistCase listed() { return makeWorklist(one_.store, {}).at(0); }
};

TEST_F(Worklist, TellsHowFarACaseIsAndWhy)
{
    EXPECT_EQ(listed().state, WorkState::queued);
    one_.record("segment", {{"verdict", "colon"}});
    EXPECT_EQ(listed().state, WorkState::running);
    EXPECT_FALSE(listed().scans[0].ready());
    one_.complete();
    EXPECT_EQ(listed().state, WorkState::done);
    EXPECT_EQ(listed().progress, 1);
    EXPECT_TRUE(listed().scans[0].ready());
    EXPECT_TRUE(listed().scans[0].organ.isColon());
}

TEST_F(Worklist, TellsWhatIsRefusedFromWhatIsKeptAndWhy)
{
    ScanRecord scan = one_.scan;
    const CaseRecord a_case = one_.store.requireCase("c1");
    scan.role = ScanRole::kept;
    scan.ingest["kept_because"] = "4 slices";
    one_.store.addScan(a_case, scan, {}, false);
    EXPECT_EQ(nameOf(listed().state), "kept");
    EXPECT_EQ(listed().reason, "4 slices");
    one_.store.addScan(a_case, one_.scan, {}, true);
    one_.record("segment", {{"verdict", "colon"}});
    one_.complete();
    scan.role = ScanRole::refused;
    scan.ingest["refused"] = {{{"object", "1.2.3"}, {"why", "cut off"}}, {{"why", "no even stack"}}};
    one_.store.addScan(a_case, scan, {}, false);
    EXPECT_EQ(nameOf(listed().state), "refused") << "also of a scan that was done";
    EXPECT_EQ(listed().reason, "no even stack");
}

TEST_F(Worklist, TellsWhyAScanFailed)
{
    one_.fail();
    EXPECT_EQ(listed().state, WorkState::failed);
    EXPECT_EQ(listed().reason, "a gap of 40 mm");
    retryCase(one_.store, {}, "c1");
    EXPECT_EQ(listed().state, WorkState::queued);
}

TEST_F(Worklist, AScanWithoutAColonIsSpoiledWhereCorrectionsLeftNoneAndRetriedWithoutThem)
{
    one_.record("segment", {{"verdict", "no colon"}, {"reason", "a head"}});
    one_.complete();
    EXPECT_EQ(listed().scans[0].reason, "no colon: a head");
    EXPECT_FALSE(listed().scans[0].spoiled());
    replaceCorrections(one_.store, {}, one_.scan, {.drop = {{1, 2, 3}}});
    EXPECT_TRUE(listed().scans[0].spoiled());
    retryCase(one_.store, {}, "c1");
    EXPECT_TRUE(readCorrections(one_.scanFolder()).empty());
}

TEST_F(Worklist, ShowsQualityReportsAndMarkers)
{
    ScanQuality quality;
    quality.whole = {.median_radius_mm = 18.4, .volume_ml = 100, .fluid_ml = 7};
    quality.reason = "sigmoid collapsed over 38 mm";
    one_.record("quality", {{"parts", nlohmann::json::array()}, {"quality", toJson(quality)}});
    one_.store.saveMarker("c1", {.scan_id = "s1"});
    EXPECT_EQ(listed().scans[0].quality, "radius 18 mm, fluid 7 %, sigmoid collapsed over 38 mm");
    EXPECT_FALSE(listed().scans[0].adequate);
    EXPECT_EQ(listed().reports, 0);
    EXPECT_EQ(listed().markers, 1);
}

TEST_F(Worklist, CountsEveryReportOnceWhereverItWasWritten)
{
    const support::TemporaryFolder elsewhere;
    const auto as = [](int number) { return "a report, " + std::to_string(number); };
    EXPECT_EQ(writeDraft(one_.store, "c1", elsewhere / "x.pdf", as).number, 1);
    EXPECT_EQ(readFile(elsewhere / "x.pdf"), "a report, 1");
    EXPECT_EQ(listed().reports, 1);
    const WrittenDraft second = writeDraft(one_.store, "c1", {}, as);
    EXPECT_EQ(second.file, reportFile(one_.store, "c1", 2));
    EXPECT_EQ(readFile(second.file), "a report, 2");
    EXPECT_EQ(listed().reports, second.number);
    std::filesystem::remove(second.file);
    EXPECT_EQ(listed().reports, 2) << "it was written";
}

TEST_F(Worklist, AReportThatCouldNotBeWrittenUsesUpNoNumber)
{
    const auto as = [](int number) { return std::to_string(number); };
    EXPECT_THROW(writeDraft(one_.store, "c1", one_.store.folder() / "nowhere" / "x.pdf", as), Error);
    const auto failing = [](int) -> std::string { throw Error(ErrorCode::store, "the disk is full"); };
    EXPECT_THROW(writeDraft(one_.store, "c1", {}, failing), Error);
    EXPECT_EQ(listed().reports, 0);
    EXPECT_EQ(writeDraft(one_.store, "c1", {}, as).number, 1);
}

TEST_F(Worklist, OfTwoReportsDrawnAtOnceEachHasItsNumber)
{
    bool other_came = false;
    const WrittenDraft slow = writeDraft(one_.store, "c1", {}, [&](int number) {
        if (!std::exchange(other_came, true)) {
            EXPECT_EQ(writeDraft(one_.store, "c1", {}, [](int) { return std::string("quick"); }).number, 1);
        }
        return "slow, " + std::to_string(number);
    });
    EXPECT_EQ(slow.number, 2);
    EXPECT_EQ(readFile(slow.file), "slow, 2");
    EXPECT_EQ(readFile(reportFile(one_.store, "c1", 1)), "quick");
    EXPECT_EQ(listed().reports, 2);
}

TEST_F(Worklist, IsWrittenWithTheKeysThatOthersRelyOn)
{
    const nlohmann::json json = toJson(makeWorklist(one_.store, {}))["cases"][0];
    for (const char* key : {"id", "patient", "study_uid", "state", "reason", "flags", "markers", "created", "scans"})
        EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json["state"], "queued");
    EXPECT_EQ(json["scans"][0]["role"], "scan");
    EXPECT_EQ(json["scans"][0]["folder"], one_.scanFolder().string());
}

}  // namespace
}  // namespace vicon
