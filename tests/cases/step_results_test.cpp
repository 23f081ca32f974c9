#include "vicon/cases/step_results.h"

#include <gtest/gtest.h>

#include "vicon/core/error.h"

namespace vicon {
namespace {

using nlohmann::json;

TEST(StepResults, HaveOneJsonFormThatIsReadBack)
{
    const json segment = json::parse(
        R"({"verdict": "no airway tree", "confidence": 0.9, "reason": "no tube", "organ": "airway", "noise_hu": 21.5,
            "plan": {"pieces": [], "bridges": []}, "limit_hu": -930,
            "bridges": [{"from_mm": [1, 2, 3], "to_mm": [4, 5, 6], "length_mm": 7, "confidence": 0.5, "reason": "why",
                         "certain": false}]})");
    const SegmentFound found = segmentFoundFromJson(segment);
    EXPECT_EQ(found.verdict, Verdict::absent);
    EXPECT_EQ(found.organ_title, "airway tree");
    EXPECT_EQ(found.organ, Organ("airway"));
    EXPECT_EQ(found.bridges.at(0).to_mm, Point3(4, 5, 6));
    EXPECT_EQ(toJson(found), segment);
    EXPECT_EQ(found.measures, json({{"limit_hu", -930}})) << "the rest alone";
    EXPECT_EQ(found.acquiredNoise_hu(), 21.5);
    EXPECT_EQ(segmentFoundFromJson({{"noise_hu", 18}, {"acquired_noise_hu", 80.5}}).acquiredNoise_hu(), 80.5);
    for (const char* tree_or_path : {R"({"length_mm": 1600.5, "pieces": [{"path_voxels": 3}]})",
                                     R"({"length_mm": 200, "branches": 9, "tips": 5, "total_length_mm": 900})"})
        EXPECT_EQ(toJson(skeletonFoundFromJson(json::parse(tree_or_path))), json::parse(tree_or_path));
    const json resample = json::parse(R"({"acquired_size": [512, 512, 400], "acquired_spacing_mm": [0.7, 0.7, 1],
                                          "size": [512, 512, 570], "spacing_mm": 0.7})");
    EXPECT_EQ(toJson(resampleFoundFromJson(resample)), resample);
    for (const char* tissue : {R"({"not_sought": "no wall"})", R"({"measures": {"blur_mm": 0.71, "level_voxels": 9}})",
                               R"({"measures": {"level_voxels": 9}})"})
        EXPECT_EQ(toJson(tissueFoundFromJson(json::parse(tissue))), json::parse(tissue));
    EXPECT_EQ(tissueFoundFromJson(json::parse(R"({"measures": {"blur_mm": 0.71}})")).blur_mm, 0.71);
    const json subdivide = {{"method", "flood"}, {"triangles", 1000}, {"segments", 40}};
    EXPECT_EQ(toJson(subdivideFoundFromJson(subdivide)), subdivide);
    const json potential = {{"largest_wall_distance_mm", 31.5}, {"largest_exit_distance_mm", 1700.5}};
    EXPECT_EQ(toJson(potentialFoundFromJson(potential)), potential);
    const json of_cavity = {{"largest_wall_distance_mm", 41.5}};
    EXPECT_EQ(toJson(potentialFoundFromJson(of_cavity)), of_cavity);
    json recorded = potential;
    recorded["files"] = {{"wall_distance.mha", 12}};
    EXPECT_EQ(toJson(potentialFoundFromJson(recorded)), potential) << "the record's files are not the step's";
    for (const char* quality : {R"({"not_measured": "of a colon"})", R"({"parts": [], "parts_unknown": "too short"})"})
        EXPECT_EQ(toJson(qualityFoundFromJson(json::parse(quality))), json::parse(quality));
}

TEST(StepResults, VerdictsAreToldByTheirTitles)
{
    for (const auto& [verdict, text] : {std::pair{Verdict::found, "colon"}, std::pair{Verdict::unsure, "unsure"},
                                        std::pair{Verdict::absent, "no colon"}}) {
        EXPECT_EQ(verdictText(verdict, "colon"), text);
        EXPECT_EQ(verdictFrom(text), verdict);
    }
}

TEST(StepResults, WarnOfAnOrganThatWasNotFoundOrNotSurely)
{
    const auto warning = [](const json& result) {
        return resultsOf({{.step = "segment", .result = result}}).warning();
    };
    EXPECT_EQ(warning({{"verdict", "colon"}, {"reason", "three pieces"}}), "");
    EXPECT_EQ(warning({{"verdict", "unsure"}, {"reason", "a gap"}}), "unsure: a gap");
    EXPECT_EQ(warning({{"verdict", "no colon"}, {"reason", "a head"}}), "no colon: a head");
    EXPECT_EQ(resultsOf({}).warning(), "");
    EXPECT_TRUE(resultsOf({}).organ().isColon());
}

TEST(StepResults, OfTheTissueStepKeepWhereTaggingIsMottled)
{
    TissueFound found;
    found.untrusted.mottled = {
        .block_mm = 4.05, .blocks_mm = {{-105.42, -108.12, 3.5}, {1, 2, 3}}, .shares = {1, 0.25}};
    const TissueFound read = tissueFoundFromJson(toJson(found));
    EXPECT_EQ(read.untrusted.mottled.block_mm, 4.05);
    ASSERT_EQ(read.untrusted.mottled.blocks_mm.size(), 2U);
    EXPECT_EQ(read.untrusted.mottled.shares, found.untrusted.mottled.shares);
    EXPECT_NEAR(distance(read.untrusted.mottled.blocks_mm[0], found.untrusted.mottled.blocks_mm[0]), 0, 0.01);
    EXPECT_TRUE(tissueFoundFromJson(toJson(TissueFound())).untrusted.mottled.blocks_mm.empty());
    for (const auto& [side_mm, x_mm] : {std::pair(0.0, 1.0), std::pair(1e-300, 1.0), std::pair(4.0, 1e300)}) {
        const json damaged = {{"mottled", {{"block_mm", side_mm}, {"blocks_mm", {{x_mm, 2, 3}}}}}};
        EXPECT_THROW(tissueFoundFromJson(damaged), Error) << side_mm << ", " << x_mm;
    }
}

TEST(StepResults, OfTheTissueStepKeepFaintWalls)
{
    TissueFound found;
    found.untrusted.faint = {{{-44.9, -76.5, 26.7}, 2.5}, {{1, 2, 3}, 0.5}};
    const TissueFound read = tissueFoundFromJson(toJson(found));
    ASSERT_EQ(read.untrusted.faint.size(), 2U);
    EXPECT_EQ(distance(read.untrusted.faint[0].middle_mm, found.untrusted.faint[0].middle_mm), 0);
    EXPECT_EQ(read.untrusted.faint[1].area_mm2, 0.5);
    EXPECT_TRUE(tissueFoundFromJson(toJson(TissueFound())).untrusted.faint.empty());
    for (const auto& [x_mm, area_mm2] : {std::pair(1e300, 1.0), std::pair(1.0, -1.0), std::pair(1.0, 1e300)}) {
        const json wall = {{"middle_mm", {x_mm, 2, 3}}, {"area_mm2", area_mm2}};
        EXPECT_THROW(tissueFoundFromJson({{"faint_walls", json::array({wall})}}), Error) << x_mm << ", " << area_mm2;
    }
}

TEST(StepResults, OfAnotherShapeAreSaidToBe)
{
    EXPECT_THROW(resultsOf({{.step = "segment", .result = {{"confidence", "much"}}}}), Error);
    EXPECT_THROW(resultsOf({{.step = "resample", .result = {{"size", {2e108, 4, 4}}}}}), Error) << "fits no int";
    EXPECT_THROW(resultsOf({{.step = "resample", .result = {{"size", {4, 4}}}}}), Error);
}

TEST(ScanQuality, IsReadBackWithItsNotesAndWithoutThemFromBefore)
{
    ScanQuality quality;
    quality.whole = {
        .median_radius_mm = 16, .collapsed_mm = 40, .collapsed_fraction = 0.025, .volume_ml = 2000, .fluid_ml = 500};
    quality.parts = {quality.whole};
    quality.parts[0].part = ColonPart::sigmoid;
    quality.parts[0].mottled_ml = 2.5;
    quality.notes = {{QualityReason::collapsed, ColonPart::sigmoid, 38.4},
                     {QualityReason::noise, {}, 45},
                     {QualityReason::mottled, ColonPart::caecum, 2.73},
                     {QualityReason::faint_walls, ColonPart::ascending, 1},
                     {QualityReason::faint_walls, {}, 3}};
    quality.reason = "sigmoid collapsed over 38 mm; more noise than usual: 45 HU";
    json written = toJson(quality);
    EXPECT_EQ(written["fluid_fraction"], 0.25);
    EXPECT_EQ(written["parts"][0]["name"], "sigmoid");
    EXPECT_EQ(toJson(scanQualityFromJson(written)), written);
    EXPECT_EQ(scanQualityFromJson(written).parts[0].mottled_ml, 2.5);
    EXPECT_EQ(textOf(quality.notes[2]), "2.7 ml of stool or mottled tagging, caecum");
    EXPECT_EQ(textOf(quality.notes[3]), "1 wall hardly shown, ascending");
    EXPECT_EQ(textOf(quality.notes[4]), "3 walls hardly shown");
    EXPECT_EQ(textOf(quality.notes[0]) + "; " + textOf(quality.notes[1]), quality.reason);
    written.erase("notes");
    EXPECT_EQ(scanQualityFromJson(written).reason, quality.reason);
    EXPECT_TRUE(scanQualityFromJson(written).notes.empty());
}

}  // namespace
}  // namespace vicon
