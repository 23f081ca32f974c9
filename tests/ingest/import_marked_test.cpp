// What people have said about a scan outlives whatever arrives: new material stands beside it.
#include <gtest/gtest.h>

#include <numeric>

#include "import_fixture.h"
#include "vicon/cases/report_files.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;
using Kind = ingest::ImportLine::Kind;

namespace {

class MarkedScan : public Import {
protected:
    SeriesSpec spec;
    ScanRecord scan;
    std::vector<InstanceRecord> instances;

    void SetUp() override
    {
        spec.slices = 20;
        writeSeries(folder / "first", spec);
        import({folder / "first"});
        store.database().session() << "UPDATE jobs SET state = 'done'";
        scan = onlyScan();
        instances = store.instances(scan.case_id, scan.id);
    }
    void mark() { store.saveMarker(scan.case_id, {.scan_id = scan.id, .position_mm = {1, 2, 3}, .note = "polyp"}); }
    ScanRecord now() { return store.requireScan(scan.case_id, scan.id); }
    std::vector<ScanRecord> others()
    {
        auto all = store.scans(scan.case_id);
        std::erase_if(all, [&](const ScanRecord& other) { return other.id == scan.id; });
        return all;
    }
    /// The marked scan is what it was, and what came is said to stand beside it.
    void expectUntouched(const ingest::ImportReport& report)
    {
        EXPECT_EQ(now().role, scan.role) << lines(report);
        EXPECT_EQ(now().ingest, scan.ingest);
        EXPECT_EQ(nlohmann::json(now().series), nlohmann::json(scan.series));
        const auto after = store.instances(scan.case_id, scan.id);
        ASSERT_EQ(after.size(), instances.size());
        for (std::size_t n = 0; n < after.size(); ++n)
            EXPECT_EQ(after[n].file + after[n].sha256, instances[n].file + instances[n].sha256);
        EXPECT_EQ(load(now()).grid.size[2], spec.slices);
        EXPECT_EQ(jobs(), 0) << "nothing of it is done again";
        EXPECT_TRUE(says(report, Kind::flagged, "came after")) << lines(report);
        const auto flags = store.requireCase(scan.case_id).flags;
        ASSERT_EQ(flags.size(), 1u);
        EXPECT_NE(flags[0].find(scan.id), std::string::npos);
        EXPECT_EQ(others().size(), 1u) << "it stands beside it";
    }
    ingest::ImportReport importOtherPixelsAtItsPlaces(int slice)
    {
        SeriesSpec intruder = spec;
        intruder.densities = [](Point3 p) { return 7 * p.x; };
        const fs::path file = writeSeries(folder / "intruder", intruder, {slice}).at(0);
        const auto modified = support::runCommand("dcmodify -nb -gin " + file.string());
        EXPECT_EQ(modified.exit_code, 0) << modified.output;
        return import({file});
    }
    ingest::ImportReport importThinner()
    {
        SeriesSpec thin = secondSeries(spec, "2");
        thin.step_mm.z = 1;
        thin.thickness_mm = 1;
        thin.slices = 40;
        writeSeries(folder / "thin", thin);
        return import({folder / "thin"});
    }
};

TEST_F(MarkedScan, KeepsItsRoleWhenAnotherImageComesAtAnOccupiedPlace)
{
    mark();
    expectUntouched(importOtherPixelsAtItsPlaces(5));
    EXPECT_EQ(others()[0].role, ScanRole::kept);
}

TEST_F(MarkedScan, StaysTheScanWhenAThinnerReconstructionComes)
{
    mark();
    expectUntouched(importThinner());
    EXPECT_EQ(others()[0].role, ScanRole::kept);
    EXPECT_EQ(others()[0].ingest["reconstruction_of"], scan.id);
}

TEST_F(MarkedScan, KeepsItsIdWhenMoreImagesOfAnotherMatrixComeInItsSeries)
{
    mark();
    SeriesSpec wide = spec;
    wide.columns = 20;
    wide.slices = 30;
    for (int n = 0; n < wide.slices; ++n)  // UIDs of their own
        ASSERT_EQ(support::runCommand("dcmodify -nb -gin " +
                                      writeSeries(folder / "wide" / std::to_string(n), wide, {n}).at(0).string())
                      .exit_code,
                  0);
    expectUntouched(import({folder / "wide"}));
}

TEST_F(MarkedScan, IsNotChangedByLateSlicesWhichStandBesideIt)
{
    mark();
    SeriesSpec longer = spec;
    longer.slices = 35;
    std::vector<int> late(15);
    std::iota(late.begin(), late.end(), 20);
    writeSeries(folder / "late", longer, late);
    expectUntouched(import({folder / "late"}));
    EXPECT_EQ(store.instances(scan.case_id, others()[0].id).size(), 15u);
}

TEST_F(MarkedScan, CorrectionsReviewsAndReportsHoldItLikeMarkers)
{
    const fs::path of_scan = store.scanFolder(scan.case_id, scan.id);
    replaceFile(of_scan / "corrections.json", R"({"add":[],"cut":[[1,2,3]],"drop":[]})");
    expectUntouched(importThinner());
}

TEST_F(MarkedScan, AReviewedBridgeHoldsIt)
{
    replaceFile(store.scanFolder(scan.case_id, scan.id) / "bridge_reviews.json", R"({"bridges":[{"verdict":"good"}]})");
    expectUntouched(importOtherPixelsAtItsPlaces(3));
}

TEST_F(MarkedScan, AReportHoldsIt)
{
    writeDraft(store, scan.case_id, folder / "r.pdf", [](int) { return std::string("a report"); });
    expectUntouched(importThinner());
}

TEST_F(MarkedScan, ASignedReportIsNamedByWhatCameAfterIt)
{
    store.database().session() << "INSERT INTO report_versions (case_id, version, state, replaces, reason, person, at,"
                                  " software, digest, content, file, file_sha256)"
                                  " VALUES (:c, 1, 'signed', 0, '', 'a', '', '', 'd', '{}', '', '')",
        soci::use(scan.case_id);
    expectUntouched(importThinner());
    EXPECT_NE(store.requireCase(scan.case_id).flags.at(0).find("came after its report was signed (version 1)"),
              std::string::npos);
    std::string content;
    store.database().session() << "SELECT digest || content FROM report_versions", soci::into(content);
    EXPECT_EQ(content, "d{}") << "it stays as it is";
}

TEST_F(MarkedScan, TheSameImagesAgainChangeNothingAndAFlagComesOnce)
{
    mark();
    importThinner();
    store.database().session() << "UPDATE cases SET flags = '[]'";  // a person has decided
    const auto before = stateOf(store);
    const auto report = import({folder / "first", folder / "thin"});
    EXPECT_EQ(report.scans_unchanged, 2) << lines(report);
    EXPECT_EQ(stateOf(store), before);
}

TEST_F(MarkedScan, ALostFileOfItIsMendedByTheSameImage)
{
    mark();
    const auto before = stateOf(store);
    fs::remove(store.scanFolder(scan.case_id, scan.id) / "dicom" / instances[4].file);
    import({folder / "first"});
    EXPECT_EQ(stateOf(store), before);
}

TEST_F(MarkedScan, WithoutMarksAThinnerReconstructionTakesItsPlaceAsEver)
{
    importThinner();
    EXPECT_EQ(now().role, ScanRole::kept);
    EXPECT_EQ(others()[0].role, ScanRole::scan);
    EXPECT_TRUE(store.requireCase(scan.case_id).flags.empty());
}

TEST_F(MarkedScan, AnotherAcquisitionIsAScanOfItsOwnBesideIt)
{
    mark();
    SeriesSpec prone = secondSeries(spec, "3");
    prone.patient_position = "HFP";
    prone.acquisition_number = "2";
    prone.acquisition_time = "102500";
    writeSeries(folder / "prone", prone);
    const auto report = import({folder / "prone"});
    EXPECT_EQ(now().role, ScanRole::scan);
    EXPECT_EQ(others().at(0).role, ScanRole::scan);
    EXPECT_EQ(jobs(), 1);
    EXPECT_TRUE(says(report, Kind::flagged, "came after this case was marked")) << lines(report);
}

}  // namespace
