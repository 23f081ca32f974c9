#include "quality_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pdf_fixture.h"
#include "vicon/support/support.h"

namespace vicon::report {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

ScanEntry supineScan()
{
    ScanEntry entry;
    entry.scan.series.number = 1;
    entry.scan.series.patient_position = "HFS";
    entry.skeleton_length_mm = 1600;
    ScanQuality& quality = entry.quality.emplace();
    quality.whole = {.median_radius_mm = 16.2,
                     .collapsed_mm = 14,
                     .collapsed_fraction = 0.0088,
                     .volume_ml = 1699.2,
                     .fluid_ml = 212.4};
    quality.parts = {{.part = ColonPart::rectum, .median_radius_mm = 20, .volume_ml = 100, .adequate = true},
                     {.part = ColonPart::sigmoid,
                      .median_radius_mm = 12,
                      .collapsed_mm = 14,
                      .collapsed_fraction = 0.03,
                      .volume_ml = 150,
                      .fluid_ml = 3}};
    quality.reason = "sigmoid collapsed over 14 mm";
    quality.noise_hu = 14.25;
    return entry;
}

ScanEntry proneScan()
{
    ScanEntry entry = supineScan();
    entry.scan.series.number = 2;
    entry.scan.series.patient_position = "HFP";
    entry.quality->parts[0].part = ColonPart::caecum;
    entry.quality->parts[1].adequate = true;
    entry.quality->parts[1].collapsed_mm = 0;
    return entry;
}

TEST(QualityTable, PutsThePartsOfBothPositionsBesideEachOtherAndTheWholeLast)
{
    const ScanEntry supine = supineScan(), prone = proneScan();
    const std::vector<QualityRow> rows = qualityRows({&supine, &prone});
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0].part, "rectum");
    ASSERT_TRUE(rows[0].scans[0]);
    EXPECT_EQ(rows[0].scans[0]->radius, "20 mm");
    EXPECT_EQ(rows[0].scans[0]->collapsed, "none");
    EXPECT_FALSE(rows[0].scans[1]) << "the prone scan has no rectum";
    EXPECT_EQ(rows[1].part, "sigmoid");
    EXPECT_EQ(rows[1].scans[0]->fluid, "3 ml, 2 %");
    EXPECT_EQ(rows[1].scans[0]->collapsed, "14 mm, 3 %");
    EXPECT_FALSE(rows[1].scans[0]->adequate);
    EXPECT_TRUE(rows[1].scans[1]->adequate);
    EXPECT_EQ(rows[2].part, "caecum");
    EXPECT_FALSE(rows[2].scans[0]);
    EXPECT_EQ(rows[3].part, "whole colon");
    EXPECT_EQ(rows[3].scans[0]->fluid, "212 ml, 12 %");
}

TEST(QualityTable, IsEmptyForScansWithoutParts)
{
    ScanEntry none, whole = supineScan();
    whole.quality->parts.clear();
    EXPECT_TRUE(qualityRows({&none, &whole}).empty());
}

TEST_F(PdfWriter, TheTableOfQualityShowsBothPositionsAndStaysAwayWhereNothingWasMeasured)
{
    const auto layout = [&] {
        write();
        return support::runCommand("pdftotext -layout " + pdf_.string() + " -").output;
    };
    EXPECT_THAT(layout(), Not(HasSubstr("Distension and fluid")));
    content_.scans = {supineScan(), proneScan()};
    const std::string text = layout();
    EXPECT_THAT(text, ContainsRegex("rectum +sigmoid +descending .*ascending +caecum +whole colon"));
    EXPECT_THAT(text, ContainsRegex("Supine, head first · series 1\n *Radius +20 mm +12 mm +not found"));
    EXPECT_THAT(text,
                ContainsRegex("Fluid +0 ml, 0 % +3 ml, 2 % +not found.*\n *Collapsed +none +14 mm, 3 % +not found"));
    EXPECT_THAT(text, ContainsRegex("Adequate +yes +NO +not found"));
    EXPECT_THAT(text, ContainsRegex("Prone, head first · series 2\n *Radius +not found +12 mm"));
    expectTidy(pdf_);
}

}  // namespace
}  // namespace vicon::report
