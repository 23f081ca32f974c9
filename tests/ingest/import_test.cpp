// What an import leaves in the store: the bytes as they came, the same state in whatever parts and however often.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <functional>
#include <mutex>
#include <numeric>
#include <set>

#include "import_fixture.h"
#include "vicon/core/error.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;

namespace {

TEST_F(Import, StoresTheBytesAsTheyCamePrivatelyAndQueuesTheScan)
{
    const auto files = writeSeries(folder / "in", {});
    const auto report = import({folder / "in"});
    EXPECT_EQ(report.scans_stored, 1) << lines(report);
    const ScanRecord scan = onlyScan();
    EXPECT_EQ(scan.role, ScanRole::scan);
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

TEST_F(Import, APathThatDoesNotExistIsAnError)
{
    EXPECT_THROW(import({folder / "nowhere"}), Error);
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

TEST_F(Import, GoesOnBetweenTheStudiesOfAnotherOneAndLeavesItWhatItUnpacked)
{
    writeSeries(folder / "in", {});
    SeriesSpec other;
    other.study_uid += ".77";
    other.series_uid += ".77";
    writeSeries(folder / "other", other);
    /// Another import from within, on the first word of this one's storing.
    struct Interrupted : Progress {
        std::function<void()> then;
        std::once_flag once;
        void report(double, std::string_view what) override
        {
            if (what == "storing studies")
                std::call_once(once, then);
        }
    } interrupted;
    int stored = 0;
    bool left_alone = false;
    interrupted.then = [&] {
        struct Impatient : Progress {
            const std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();
            void report(double, std::string_view) override {}
            bool cancelled() const override
            {
                return std::chrono::steady_clock::now() - begun > std::chrono::seconds(60);
            }
        } impatient;
        CaseStore own(store.place());
        stored = ingest::importPaths(own, {folder / "other"}, options, impatient).scans_stored;
        left_alone = !fs::is_empty(store.folder() / "incoming");
    };
    EXPECT_EQ(ingest::importPaths(store, {folder / "in"}, options, interrupted).scans_stored, 1);
    EXPECT_EQ(stored, 1) << "it waited for the other one";
    EXPECT_TRUE(left_alone) << "a folder of an import that lives was taken for a leftover";
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
