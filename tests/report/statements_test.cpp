#include "vicon/report/statements.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vicon::report {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::string said(const std::vector<Statement>& statements, const std::string& label)
{
    for (const Statement& statement : statements)
        if (statement.label == label)
            return statement.text;
    return "(nothing)";
}

TEST(Statements, WhatTheCaseDoesNotSayIsNotGiven)
{
    EXPECT_THAT(patientStatements({}),
                ElementsAre(Statement{"Name", "not given"}, Statement{"Patient ID", "not given"},
                            Statement{"Birth date", "not given"}, Statement{"Sex", "not given"}));
    EXPECT_THAT(studyStatements({}), ElementsAre(Statement{"Study date", "not given"}));
}

TEST(Statements, PatientAndStudyComeFromTheCase)
{
    CaseRecord c;
    c.patient = {"PID-1", "Adams^John", "19610412", "M"};
    c.study = {"1.2.3", "S7", "20261120", "101530", "CT colonography", "A-99", "Dorian^Ruth^^Dr.", "St. Mary's"};
    EXPECT_THAT(patientStatements(c), ElementsAre(Statement{"Name", "Adams, John"}, Statement{"Patient ID", "PID-1"},
                                                  Statement{"Birth date", "1961-04-12"}, Statement{"Sex", "male"}));
    EXPECT_THAT(studyStatements(c),
                ElementsAre(Statement{"Study date", "2026-11-20, 10:15"}, Statement{"Description", "CT colonography"},
                            Statement{"Accession", "A-99"}, Statement{"Study ID", "S7"},
                            Statement{"Referred by", "Dorian, Dr. Ruth"}, Statement{"Institution", "St. Mary's"}));
}

ScanEntry preparedScan()
{
    ScanEntry entry;
    entry.scan.series.number = 3;
    entry.scan.series.description = "Colon 1.0";
    entry.scan.series.patient_position = "FFP";
    entry.scan.ingest = nlohmann::json::parse(
        R"({"geometry": {"slices": 430, "columns": 512, "rows": 400, "spacing_mm": [0.676, 0.676, 1.0], "tilt_deg": 12},
            "repairs": ["1 slice missing at F 120.0 mm"],
            "refused": [{"object": "1.2", "why": "truncated"}, {"object": "1.3", "why": "truncated"}]})");
    entry.skeleton_length_mm = 1594.6;
    entry.verdict = Verdict::found;
    entry.organ_title = "colon";
    entry.confidence = 0.86;
    entry.reason = "three pieces of gas";
    entry.bridges = {{{.length_mm = 14.2, .confidence = 0.93, .certain = true}, {}},
                     {{.length_mm = 31, .confidence = 0.4, .reason = "the gap is long"},
                      BridgeReview{BridgeVerdict::confirmed, "anna", "2026-01-03"}}};
    entry.quality = ScanQuality{.whole = {.adequate = true}, .noise_hu = 14.25};
    return entry;
}

TEST(Statements, AScanSaysWhatWasFoundAndWhatWasDoneToIt)
{
    const ScanEntry entry = preparedScan();
    EXPECT_EQ(scanTitle(entry), "Prone, feet first · series 3");
    const auto s = scanStatements(entry);
    EXPECT_EQ(said(s, "Series"), "3, Colon 1.0");
    EXPECT_EQ(said(s, "Geometry"),
              "430 slices of 512 × 400, voxels of 0.68 × 0.68 × 1.00 mm, gantry tilt of 12.0° removed");
    EXPECT_EQ(said(s, "Verdict"), "colon, confidence 86 %: three pieces of gas");
    EXPECT_EQ(said(s, "Colon length"), "1595 mm along the centreline");
    EXPECT_EQ(said(s, "Collapsed"),
              "2 collapsed segments:\n14 mm, confidence 93 %\n31 mm, confidence 40 % (low): the gap is long; "
              "confirmed by anna, 2026-01-03");
    EXPECT_EQ(said(s, "Quality"), "adequate\nnoise 14 HU");
    EXPECT_EQ(said(s, "Repaired"), "1 slice missing at F 120.0 mm");
    EXPECT_EQ(said(s, "Refused"), "truncated (2 times)");
    EXPECT_EQ(said(s, "Compression"), "(nothing)");
}

TEST(Statements, QualitySaysWhetherAdequateWhyNotAndTheNoise)
{
    ScanEntry entry = preparedScan();
    entry.quality = ScanQuality{.noise_hu = 14.25, .reason = "sigmoid collapsed over 14 mm"};
    EXPECT_EQ(said(scanStatements(entry), "Quality"), "not adequate: sigmoid collapsed over 14 mm\nnoise 14 HU");
}

TEST(Statements, LossyCompressionIsFlagged)
{
    ScanEntry entry = preparedScan();
    entry.scan.series.lossy = true;
    EXPECT_THAT(said(scanStatements(entry), "Compression"), HasSubstr("LOSSY"));
    ReportContent content;
    entry.scan.id = "s7";
    content.scans = {entry};
    EXPECT_TRUE(isLossy(content, "s7"));
    EXPECT_FALSE(isLossy(content, "s8"));
}

TEST(Statements, AScanThatIsNotPreparedSaysSo)
{
    EXPECT_EQ(said(scanStatements({}), "Verdict"), "not prepared");
    EXPECT_EQ(said(scanStatements({}), "Colon length"), "(nothing)");
    ScanEntry none;
    none.verdict = Verdict::absent;
    none.organ_title = "colon";
    none.confidence = 0.97;
    none.reason = "a chest";
    EXPECT_EQ(said(scanStatements(none), "Verdict"), "no colon, confidence 97 %: a chest");
}

TEST(Statements, JsonOfAnotherShapeIsPassedOver)
{
    ScanEntry entry;
    entry.skeleton_length_mm = 1;
    entry.scan.ingest = nlohmann::json::parse(
        R"({"geometry": {"slices": "many", "spacing_mm": [1, 2]}, "repairs": 3, "refused": [7, null, {"object": "1"}]})");
    EXPECT_EQ(said(scanStatements(entry), "Refused"), "(nothing)");
    entry.scan.ingest = nullptr;
    EXPECT_NO_THROW(scanStatements(entry));
}

TEST(Statements, ManyNotesAreCutShortWithTheirNumber)
{
    ScanEntry entry;
    for (int n = 0; n < 20; ++n)
        entry.scan.ingest["repairs"].push_back("repair " + std::to_string(n));
    EXPECT_THAT(said(scanStatements(entry), "Repaired"),
                AllOf(HasSubstr("repair 5\nand 14 more"), HasSubstr("repair 0")));
}

TEST(Statements, AMarkerGivesTheMeasuredDistanceFirstAndTheEstimateLast)
{
    MarkerEntry entry;
    entry.marker.position_mm = {85.2, 12, 340.5};
    entry.marker.station_mm = 412;
    entry.marker.from_caecum_mm = 1183;
    entry.marker.fraction = 412.0 / 1595;
    entry.part_name = "sigmoid";
    EXPECT_THAT(
        markerStatements(entry),
        ElementsAre(
            Statement{"Position", "L 85.2, P 12.0, H 340.5 mm (left, posterior, headward of the scan's origin)"},
            Statement{"Segment", "sigmoid"}, Statement{"From rectal end", "412 mm along the centreline"},
            Statement{"From caecal end", "1183 mm along the centreline"},
            Statement{"Fraction", "25.8 % of the whole, 1595 mm, from the rectal end"},
            Statement{"By endoscope", "estimated: about 32 cm (0.78 × CT distance, left colon)"}));
    entry.marker.size = MarkerSize{.straight_mm = 6.24, .along_mm = 8};
    entry.marker.partners = {"m7"};
    EXPECT_EQ(said(markerStatements(entry), "Size"), "6.2 mm straight, 8.0 mm along the wall");
    EXPECT_EQ(said(markerStatements(entry), "Same finding"), "m7");
    entry.marker.size->plane = PlaneSize{.diameter_mm = 9.04};
    EXPECT_EQ(said(markerStatements(entry), "Size"),
              "6.2 mm straight, 8.0 mm along the wall, 9.0 mm largest in the best plane");
    entry.marker.size.reset();
    entry.marker.partners.clear();
    EXPECT_EQ(said(markerStatements(entry), "Same finding"), "(nothing)");
    EXPECT_EQ(said(markerStatements(entry), "Size"), "(nothing)");
    entry.part_name.clear();
    EXPECT_EQ(said(markerStatements(entry), "Segment"), "(nothing)");
    EXPECT_THAT(said(markerStatements(entry), "By endoscope"), HasSubstr("24 to 32 cm"));
}

TEST(Statements, AMarkerGivesTheDensityOfItsBiopsy)
{
    MarkerEntry entry;
    DensitySample& density = entry.marker.density.emplace();
    density = {.radius_mm = 4, .voxels = 31, .mean_hu = 41.6, .sd_hu = 18.2, .fat_fraction = 0.1};
    EXPECT_EQ(said(markerStatements(entry), "Density"), "42 \u00b1 18 HU, of 31 voxels within 4.0 mm");
    density.fat_fraction = 0.45;
    EXPECT_EQ(said(markerStatements(entry), "Density"),
              "42 \u00b1 18 HU, of 31 voxels within 4.0 mm; 45 % of them of fat attenuation");
    entry.marker.density.reset();
    EXPECT_EQ(said(markerStatements(entry), "Density"), "(nothing)");
}

}  // namespace
}  // namespace vicon::report
