// What an import refuses, quarantines or flags, and that the rest goes on.
#include <gtest/gtest.h>

#include <atomic>

#include <cmath>

#include "import_fixture.h"

namespace fs = std::filesystem;
using namespace vicon;
using namespace vicon::test;
using Kind = ingest::ImportLine::Kind;

namespace {

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

TEST_F(Import, WhatAnObjectDoesNotSayOfItsPatientContradictsNothing)
{
    SeriesSpec first, nameless = secondSeries(first, "2"), other = secondSeries(first, "3");
    first.patient_name = first.birth_date = "";
    nameless.patient_id = "";
    other.patient_name = "Smith^Joan";
    std::map<std::string, std::string> said;
    for (const SeriesSpec& spec : {first, nameless, other}) {
        writeSeries(folder / spec.series_uid, spec);
        said[spec.series_uid] = lines(import({folder / spec.series_uid}));
    }
    EXPECT_EQ(said[nameless.series_uid].find("quarantined"), std::string::npos) << said[nameless.series_uid];
    EXPECT_NE(said[other.series_uid].find("quarantined"), std::string::npos) << "the second name is no longer open";
    const Patient patient = store.cases().at(0).patient;
    EXPECT_EQ(patient.id, "P1");
    EXPECT_EQ(patient.name, "Doe^Jane") << "the first that was said";
    EXPECT_EQ(patient.birth_date, "19600101");
    EXPECT_EQ(store.scans(store.cases().at(0).id).size(), 2u);
}

TEST_F(Import, AnObjectOfNoFramesIsRefusedForThat)
{
    const SeriesSpec spec;
    const fs::path file = writeEnhanced(folder / "in/enhanced.dcm", spec, {0, 1, 2});
    ASSERT_EQ(support::runCommand("dcmodify -nb -m '(0028,0008)=0' " + file.string()).exit_code, 0);
    const auto report = import({file});
    EXPECT_TRUE(says(report, Kind::refused, "it claims to have 0 frames")) << lines(report);
}

TEST_F(Import, BeingToldToStopIsHeardBetweenTheFramesThatAreProven)
{
    const fs::path file = writeEnhanced(folder / "in/enhanced.dcm", {}, {0, 1, 2, 3, 4, 5, 6, 7});
    struct Counting : Progress {
        void report(double, std::string_view what) override { storing = storing || what == "storing studies"; }
        bool cancelled() const override
        {
            asked += storing ? 1 : 0;
            return false;
        }
        std::atomic<bool> storing = false;
        mutable std::atomic<int> asked = 0;
    } counting;
    ingest::importPaths(store, {file}, options, counting);
    EXPECT_GT(counting.asked, 8);
}

TEST_F(Import, WhatWouldMakeTooLargeAVolumeIsNotDecodedToBeProven)
{
    writeEnhanced(folder / "in/enhanced.dcm", {}, {0, 1, 2, 3, 4, 5, 6, 7});
    options.largest_volume_mvoxel = 7 * 16 * 16 / 1e6;
    const auto report = import({folder / "in"});
    EXPECT_TRUE(says(report, Kind::refused, "its volume would be larger")) << lines(report);
    EXPECT_EQ(report.not_stored.size(), 1u);
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

}  // namespace
