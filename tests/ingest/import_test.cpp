#include <gmock/gmock.h>

#include <array>
#include <fstream>
#include <set>

#include "dicom_writer.h"
#include "store_fixture.h"
#include "vicon/core/error.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;
using Kind = ingest::ImportLine::Kind;

namespace {

class Import : public StoreFixture {
protected:
    /// Everything in the store that an import decides, without times: rows, and every file with its content's hash.
    static std::map<std::string, std::string> stateOf(CaseStore& store)
    {
        std::map<std::string, std::string> state;
        for (const CaseRecord& c : store.cases()) {
            state["case " + c.id] = nlohmann::json(c.patient).dump() + nlohmann::json(c.flags).dump();
            for (const ScanRecord& s : store.scans(c.id)) {
                state["scan " + c.id + s.id] = s.role + s.ingest.dump() + nlohmann::json(s.series).dump();
                for (const InstanceRecord& i : store.instances(c.id, s.id))
                    state["instance " + i.sop_uid] = i.scan_id + i.file + i.sha256;
            }
        }
        const soci::rowset<soci::row> jobs =
            (store.database().session().prepare << "SELECT case_id, scan_id, state FROM jobs");
        for (const auto& job : jobs)
            state["job " + job.get<std::string>(0) + job.get<std::string>(1)] = job.get<std::string>(2);
        for (const char* part : {"cases", "quarantine", "incoming"})
            for (const auto& entry : fs::recursive_directory_iterator(store.folder() / part, ignored()))
                if (entry.is_regular_file())
                    state["file " + fs::relative(entry.path(), store.folder()).string()] =
                        entry.path().filename() == "scan.json" ? withoutTime(entry.path()) : sha256OfFile(entry.path());
        return state;
    }

    static void append(const fs::path& file, const std::string& bytes)
    {
        std::ofstream(file, std::ios::binary | std::ios::app) << bytes;
    }

private:
    static std::error_code& ignored()
    {
        static std::error_code code;
        return code;
    }
    static std::string withoutTime(const fs::path& file)
    {
        auto json = nlohmann::json::parse(readFile(file));
        json.erase("created");
        return json.dump();
    }
};

SeriesSpec secondSeries(const SeriesSpec& first, const std::string& suffix)
{
    SeriesSpec spec = first;
    spec.series_uid = first.study_uid + "." + suffix;
    spec.series_number = first.series_number + 1;
    return spec;
}

TEST_F(Import, StoresTheBytesAsTheyCamePrivatelyAndQueuesTheScan)
{
    const auto files = writeSeries(folder / "in", {});
    const auto report = import({folder / "in"});
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    const ScanRecord scan = onlyScan();
    EXPECT_EQ(scan.role, "scan");
    EXPECT_EQ(scan.case_id, CaseStore::caseIdFor(SeriesSpec{}.study_uid));
    EXPECT_EQ(jobs(), 1);
    std::multiset<std::string> sent, stored;
    for (const fs::path& file : files)
        sent.insert(readFile(file));
    const fs::path dicom = store.scanFolder(scan.case_id, scan.id) / "dicom";
    for (const auto& entry : fs::directory_iterator(dicom)) {
        stored.insert(readFile(entry.path()));
        EXPECT_EQ(entry.status().permissions(), fs::perms::owner_read | fs::perms::owner_write);
    }
    EXPECT_EQ(sent, stored);
    EXPECT_EQ(fs::status(dicom).permissions(), fs::perms::owner_all);
    EXPECT_EQ(store.instances(scan.case_id, scan.id).size(), files.size());
    const auto described = nlohmann::json::parse(readFile(dicom.parent_path() / "scan.json"));
    EXPECT_EQ(described["patient"]["name"], "Doe^Jane");
    EXPECT_EQ(described["geometry"]["size"], (std::array{16, 16, 12}));
    EXPECT_EQ(described["series"]["kernel"], "B30f");
    EXPECT_EQ(described["position"], "supine");
}

TEST_F(Import, TheSameThingTwiceChangesNothing)
{
    writeSeries(folder / "in", {});
    import({folder / "in"});
    const auto before = stateOf(store);
    const auto time = fs::last_write_time(store.scanFolder(onlyScan().case_id, onlyScan().id) / "scan.json");
    const auto report = import({folder / "in", folder / "in/3.dcm"});
    EXPECT_EQ(report.scans_unchanged, 1) << lines(report);
    EXPECT_EQ(report.scans_stored + report.refused, 0);
    EXPECT_TRUE(report.anythingStored());
    EXPECT_EQ(stateOf(store), before);
    EXPECT_EQ(fs::last_write_time(store.scanFolder(onlyScan().case_id, onlyScan().id) / "scan.json"), time);
}

TEST_F(Import, PartsEndInTheSameStateAsTheWhole)
{
    SeriesSpec soft, thin, prone;
    soft.slices = 20;
    thin = secondSeries(soft, "2");
    thin.slices = 40;
    thin.step_mm.z = 1;
    thin.thickness_mm = 1;
    prone = secondSeries(soft, "3");
    prone.patient_position = "HFP";
    std::vector<fs::path> all = writeSeries(folder / "a", soft);
    for (const auto& [name, spec] : {std::pair{"b", thin}, std::pair{"c", prone}})
        for (const fs::path& file : writeSeries(folder / name, spec))
            all.push_back(file);
    CaseStore whole(folder / "whole");
    ingest::importPaths(whole, all, options, quiet);
    // Every third file first: the slices of each series arrive in three parts, each with gaps too large to be repaired.
    for (std::size_t part = 0; part < 3; ++part) {
        std::vector<fs::path> some;
        for (std::size_t n = 0; n < all.size(); ++n)
            if ((n / 4) % 3 == part)
                some.push_back(all[n]);
        const auto report = import(some);
        EXPECT_EQ(report.anythingStored(), part == 2) << lines(report);
    }
    EXPECT_EQ(stateOf(store), stateOf(whole));
    EXPECT_EQ(jobs(), 2);
}

TEST_F(Import, AScanThatGrewIsQueuedAgain)
{
    SeriesSpec spec;
    spec.slices = 20;
    std::vector<int> half(10);
    std::iota(half.begin(), half.end(), 0);
    writeSeries(folder / "in", spec, half);
    import({folder / "in"});
    store.database().session() << "UPDATE jobs SET state = 'done'";
    writeSeries(folder / "in", spec);
    EXPECT_EQ(import({folder / "in"}).scans_stored, 1);
    EXPECT_EQ(jobs(), 1);
    EXPECT_EQ(load(onlyScan()).grid.size[2], 20);
}

TEST_F(Import, OfTheReconstructionsOfAnAcquisitionTheThinnestSoftOneIsTheScan)
{
    SeriesSpec thick, thin_sharp, thin_soft, prone;
    thick.slices = 12;
    thin_sharp = secondSeries(thick, "2");
    thin_sharp.kernel = "B70f";
    thin_sharp.step_mm.z = 0.5;
    thin_sharp.thickness_mm = 0.5;
    thin_sharp.slices = 48;
    thin_soft = secondSeries(thin_sharp, "3");
    thin_soft.kernel = "B30f";
    thin_soft.step_mm.z = 1;
    thin_soft.thickness_mm = 1;
    thin_soft.slices = 24;
    prone = secondSeries(thick, "4");
    prone.patient_position = "HFP";
    prone.acquisition_number = "2";
    prone.acquisition_time = "102500";
    // In an order in which each import changes what is the scan.
    std::map<std::string, std::string> roles;
    for (const SeriesSpec& spec : {thin_sharp, thick, prone, thin_soft}) {
        writeSeries(folder / spec.series_uid, spec);
        import({folder / spec.series_uid});
    }
    for (const ScanRecord& scan : store.scans(CaseStore::caseIdFor(thick.study_uid)))
        roles[scan.series.uid] = scan.role;
    EXPECT_EQ(roles[thick.series_uid], "kept");
    EXPECT_EQ(roles[thin_sharp.series_uid], "kept");
    EXPECT_EQ(roles[thin_soft.series_uid], "scan");
    EXPECT_EQ(roles[prone.series_uid], "scan");
    EXPECT_EQ(jobs(), 2);
}

TEST_F(Import, ASecondSupineAcquisitionIsAScanOfItsOwn)
{
    SeriesSpec first, second = secondSeries(first, "2");
    second.acquisition_number = "2";
    second.acquisition_time = "101700";
    writeSeries(folder / "a", first);
    writeSeries(folder / "b", second);
    EXPECT_EQ(import({folder / "a", folder / "b"}).scans_stored, 2);
}

TEST_F(Import, FewerThanTenSlicesAreKeptAndNotQueued)
{
    SeriesSpec spec;
    spec.slices = 9;
    writeSeries(folder / "in", spec);
    const auto report = import({folder / "in"});
    EXPECT_EQ(report.images_kept, 1);
    EXPECT_TRUE(report.anythingStored());
    EXPECT_TRUE(says(report, Kind::kept, "9 slices, fewer than the 10 of a scan")) << lines(report);
    EXPECT_EQ(onlyScan().role, "kept");
    EXPECT_EQ(jobs(), 0);
    EXPECT_EQ(load(onlyScan()).grid.size[2], 9);
}

TEST_F(Import, OtherBytesUnderTheSameUidAreRefusedAndTheFirstKept)
{
    SeriesSpec spec;
    writeSeries(folder / "in", spec);
    import({folder / "in"});
    const auto before = onlyScan();
    const InstanceRecord kept = *store.findInstance(spec.sopUid(5));
    spec.densities = [](Point3) { return 7; };
    writeSeries(folder / "other", spec, {5});
    const auto report = import({folder / "other"});
    EXPECT_TRUE(says(report, Kind::refused, "same SOP Instance UID with other content")) << lines(report);
    EXPECT_EQ(report.refused, 1);
    EXPECT_EQ(store.findInstance(spec.sopUid(5))->sha256, kept.sha256);
    EXPECT_EQ(onlyScan().ingest["refused"].size(), 1u);
    EXPECT_EQ(onlyScan().ingest["geometry"], before.ingest["geometry"]);
    // Within one import the first in order of path is kept as well.
    CaseStore fresh(folder / "fresh");
    const auto once = ingest::importPaths(fresh, {folder / "in", folder / "other"}, options, quiet);
    EXPECT_EQ(once.refused, 1);
    EXPECT_EQ(fresh.findInstance(spec.sopUid(5))->sha256, kept.sha256);
}

TEST_F(Import, AnotherPatientUnderTheSameStudyGoesToQuarantine)
{
    SeriesSpec spec;
    writeSeries(folder / "in", spec);
    import({folder / "in"});
    const auto cases_before = stateOf(store);
    SeriesSpec stranger = secondSeries(spec, "2");
    stranger.patient_id = "P2";
    stranger.patient_name = "Secret^Name";
    const auto files = writeSeries(folder / "stranger", stranger);
    for (int again = 0; again < 2; ++again) {
        const auto report = import({folder / "stranger"});
        EXPECT_TRUE(says(report, Kind::quarantined, "12 objects")) << lines(report);
        EXPECT_FALSE(report.anythingStored() && report.scans_stored);
        EXPECT_EQ(lines(report).find("Secret"), std::string::npos);
        std::size_t quarantined = 0;
        for (const auto& entry : fs::recursive_directory_iterator(store.folder() / "quarantine")) {
            quarantined += entry.is_regular_file() ? 1 : 0;
            EXPECT_EQ(entry.path().string().find("Secret"), std::string::npos);
        }
        EXPECT_EQ(quarantined, files.size());
    }
    EXPECT_EQ(store.scans(onlyScan().case_id).size(), 1u);
}

TEST_F(Import, AnotherNameUnderTheSamePatientIdFlagsBothCases)
{
    SeriesSpec one, other;
    other.study_uid += "9";
    other.series_uid = other.study_uid + ".1";
    other.patient_name = "Smith^Joan";
    writeSeries(folder / "a", one);
    writeSeries(folder / "b", other);
    import({folder / "a"});
    EXPECT_TRUE(says(import({folder / "b"}), Kind::flagged, "a person must decide"));
    for (const SeriesSpec& spec : {one, other}) {
        const auto flags = store.findCaseByStudy(spec.study_uid)->flags;
        ASSERT_EQ(flags.size(), 1u);
        EXPECT_EQ(flags[0].find("Smith"), std::string::npos);
        EXPECT_EQ(flags[0].find("Doe"), std::string::npos);
    }
    EXPECT_FALSE(says(import({folder / "b"}), Kind::flagged, "")) << "a flag is raised once";
}

TEST_F(Import, ATruncatedSliceIsRefusedAndTheRestGoesOn)
{
    SeriesSpec spec;
    spec.slices = 20;
    const auto files = writeSeries(folder / "in", spec);
    fs::resize_file(files[10], fs::file_size(files[10]) - 100);
    const auto report = import({folder / "in"});
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    EXPECT_EQ(report.refused, 1);
    EXPECT_TRUE(says(report, Kind::refused, "truncated or damaged"));
    EXPECT_TRUE(says(report, Kind::repaired, "1 slice missing at z = 0.0 mm"));
    const auto refused = onlyScan().ingest["refused"];
    ASSERT_EQ(refused.size(), 1u);
    EXPECT_EQ(refused[0]["object"], spec.sopUid(10));
    // The whole file comes later: the gap is closed.
    writeSeries(folder / "again", spec, {10});
    import({folder / "again"});
    EXPECT_TRUE(onlyScan().ingest["repairs"].empty());
    EXPECT_EQ(onlyScan().ingest["geometry"]["slices"], 20);
}

TEST_F(Import, HeadersThatClaimNonsenseAreRefused)
{
    struct Nonsense {
        void (*change)(SeriesSpec&);
        const char* words;
    };
    const Nonsense cases[] = {
        {[](SeriesSpec& s) {
             s.slope = 0;
             s.densities = [](Point3) { return std::nan(""); };
             s.padding = 3;
         },
         "densities are unknown"},
        {[](SeriesSpec& s) {
             s.row = {1, 1, 0};
         },
         "not orthogonal"},
        {[](SeriesSpec& s) {
             s.column = {1, 0, 0};
         },
         "not orthogonal"},
        {[](SeriesSpec& s) { s.pixel_mm = 0; }, "size of its pixels"},
        {[](SeriesSpec& s) {
             s.bits_stored = 14;
             s.high_bit = 11;
         },
         "pixel format"},
    };
    int number = 0;
    for (const Nonsense& c : cases) {
        SeriesSpec spec;
        spec.study_uid += "." + std::to_string(++number);
        spec.series_uid = spec.study_uid + ".1";
        c.change(spec);
        writeSeries(folder / std::to_string(number), spec);
        const auto report = import({folder / std::to_string(number)});
        EXPECT_TRUE(says(report, Kind::refused, c.words)) << lines(report);
        EXPECT_FALSE(report.anythingStored());
    }
}

TEST_F(Import, LocalizersScreenSavesAndOtherModalitiesAreSetAside)
{
    SeriesSpec spec, localizer = secondSeries(spec, "2"), pet = secondSeries(spec, "3");
    localizer.image_type = "ORIGINAL\\PRIMARY\\LOCALIZER";
    pet.modality = "PT";
    writeSeries(folder / "in/a", spec);
    writeSeries(folder / "in/b", localizer, {0});
    writeSeries(folder / "in/c", pet);
    SeriesSpec in_series = localizer;  // some scanners put the localizer into the scan's own series
    in_series.series_uid = spec.series_uid;
    writeSeries(folder / "in/d", in_series, {100});
    const auto report = import({folder / "in"});
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    EXPECT_EQ(report.set_aside, 14);
    EXPECT_EQ(report.refused, 0);
    EXPECT_TRUE(says(report, Kind::set_aside, "localizer"));
    EXPECT_TRUE(says(report, Kind::set_aside, "modality PT, no CT slice (12 files)"));
    EXPECT_EQ(onlyScan().ingest["set_aside"].size(), 1u);
}

TEST_F(Import, AMissingPatientPositionIsSaidNotGuessed)
{
    SeriesSpec spec;
    spec.patient_position = "";
    writeSeries(folder / "prone HFP", spec);
    const auto report = import({folder / "prone HFP"});
    EXPECT_TRUE(says(report, Kind::repaired, "Patient Position not said")) << lines(report);
    EXPECT_EQ(onlyScan().series.patient_position, "");
}

TEST_F(Import, FilesThatAreNoDicomCostALineEach)
{
    writeSeries(folder / "in", {});
    append(folder / "in/notes.txt", "hello");
    append(folder / "in/empty", "");
    append(folder / "in/noise", std::string(5000, '\x7f'));
    append(folder / "in/header only", std::string(128, '\0') + "DICM");
    const auto report = import({folder / "in"});
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    EXPECT_EQ(report.refused, 4);
}

TEST_F(Import, APathThatDoesNotExistIsAnError)
{
    EXPECT_THROW(import({folder / "nowhere"}), Error);
}

TEST_F(Import, AnObjectOfAnotherGridBesideTheScanIsKeptApart)
{
    SeriesSpec spec, odd = spec;
    odd.columns = 20;
    writeSeries(folder / "in", spec);
    writeSeries(folder / "odd", odd, {77});
    const auto report = import({folder / "odd", folder / "in"});
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    EXPECT_EQ(report.images_kept, 1);
    // The odd one alone would have been the series; the state is the same in this order.
    CaseStore parts(folder / "parts");
    ingest::importPaths(parts, {folder / "odd"}, options, quiet);
    ingest::importPaths(parts, {folder / "in"}, options, quiet);
    EXPECT_EQ(stateOf(parts), stateOf(store));
}

TEST_F(Import, WhatAKilledImportLeftIsRemoved)
{
    writeSeries(folder / "in", {});
    const fs::path dicom =
        store.scanFolder(CaseStore::caseIdFor(SeriesSpec{}.study_uid), CaseStore::scanIdFor(SeriesSpec{}.series_uid)) /
        "dicom";
    fs::create_directories(dicom);
    fs::create_directories(store.folder() / "incoming/.vicon-tmp-unpack-99999-0");
    append(dicom / ".vicon-tmp-half.dcm", "half");
    append(store.folder() / "incoming/.vicon-tmp-unpack-99999-0/0.dcm", "half");
    import({folder / "in"});
    EXPECT_EQ(std::distance(fs::directory_iterator(dicom), {}), 12);
    EXPECT_TRUE(fs::is_empty(store.folder() / "incoming"));
}

TEST_F(Import, ALostStoredFileIsReplacedByTheSameObject)
{
    writeSeries(folder / "in", {});
    import({folder / "in"});
    const auto before = stateOf(store);
    const InstanceRecord lost = *store.findInstance(SeriesSpec{}.sopUid(4));
    fs::remove(store.scanFolder(lost.case_id, lost.scan_id) / "dicom" / lost.file);
    import({folder / "in"});
    EXPECT_EQ(stateOf(store), before);
}

TEST_F(Import, CancellingLeavesNoHalfScan)
{
    writeSeries(folder / "in", {});
    struct Impatient : Progress {
        void report(double, std::string_view) override {}
        bool cancelled() const override { return true; }
    } impatient;
    EXPECT_THROW(ingest::importPaths(store, {folder / "in"}, options, impatient), Error);
    EXPECT_TRUE(store.cases().empty());
    EXPECT_EQ(import({folder / "in"}).scans_stored, 1);
}

}  // namespace
