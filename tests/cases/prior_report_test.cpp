#include "vicon/cases/prior_report.h"

#include <gtest/gtest.h>

namespace vicon {
namespace {

using nlohmann::json;

TEST(PriorReport, AFindingsJsonHoldsAllThatIsKnownOfIt)
{
    PriorFinding finding{.uid = "1.2",
                         .name = "Finding 3",
                         .what = "Polyp",
                         .kind = FindingKind::polyp,
                         .morphology = Morphology::sessile,
                         .attenuation = Attenuation::soft_tissue,
                         .confidence = Confidence::high,
                         .size_mm = 7.5,
                         .size_from = "reader",
                         .height_mm = 3.5,
                         .volume_ml = 0.25};
    finding.sights.push_back({.marker = "m1",
                              .series_uid = "1.3",
                              .image_uid = "1.4",
                              .frame_of_reference_uid = "1.5",
                              .position_mm = Point3{1, 2, 3},
                              .part = ColonPart::sigmoid,
                              .site = "Sigmoid colon",
                              .station_mm = 300,
                              .from_caecum_mm = 1200,
                              .fraction = 0.2,
                              .part_fraction = 0.5,
                              .clock_hour = 4,
                              .size_2d_mm = 7,
                              .size_3d_mm = 7.25,
                              .size_least_mm = 6.5,
                              .size_most_mm = 8,
                              .height_mm = 3.25,
                              .volume_ml = 0.125,
                              .volume_least_ml = 0.0625,
                              .volume_most_ml = 0.25,
                              .mean_hu = 41});
    finding.others = {{"Depth", 2.5, "mm"}};
    const json expected = json::parse(R"({
        "uid": "1.2", "name": "Finding 3", "what": "Polyp", "kind": "polyp", "morphology": "sessile",
        "attenuation": "soft tissue", "confidence": "high", "size_mm": 7.5, "size_from": "reader", "height_mm": 3.5,
        "volume_ml": 0.25, "narrows_lumen": false, "invades": false, "note": "", "leading": 0,
        "others": [{"name": "Depth", "value": 2.5, "unit": "mm"}],
        "sights": [{"marker": "m1", "series_uid": "1.3", "image_uid": "1.4", "frame_of_reference_uid": "1.5",
                    "position_mm": [1.0, 2.0, 3.0], "part": "sigmoid", "site": "Sigmoid colon",
                    "station_mm": 300.0, "from_caecum_mm": 1200.0, "fraction": 0.2, "part_fraction": 0.5,
                    "clock_hour": 4, "size_2d_mm": 7.0, "size_3d_mm": 7.25, "size_least_mm": 6.5, "size_most_mm": 8.0,
                    "height_mm": 3.25, "volume_ml": 0.125,
                    "volume_least_ml": 0.0625, "volume_most_ml": 0.25, "mean_hu": 41.0}]})");
    EXPECT_EQ(toJson(finding), expected) << toJson(finding).dump(1);
    const json bare = toJson(PriorFinding{.uid = "1.2"});
    EXPECT_FALSE(bare.contains("size_mm"));
    EXPECT_FALSE(bare.contains("confidence"));
}

}  // namespace
}  // namespace vicon
