#include "vicon/cases/records.h"

#include <gtest/gtest.h>

#include "vicon/core/error.h"

namespace vicon {
namespace {

TEST(PatientPosition, NamesThePositionAndTheWayFluidFalls)
{
    struct Case {
        const char *code, *name;
        Vector3 gravity;
    };
    // DICOM PS3.3 C.7.3.1.1.2; +x is the patient's left, +y posterior.
    const Case cases[] = {
        {"HFS", "supine", {0, 1, 0}}, {"FFS", "supine", {0, 1, 0}},          {"HFP", "prone", {0, -1, 0}},
        {"FFP", "prone", {0, -1, 0}}, {"HFDL", "left decubitus", {1, 0, 0}}, {"FFDR", "right decubitus", {-1, 0, 0}},
        {"", "unknown", {0, 1, 0}},
    };
    for (const Case& c : cases) {
        EXPECT_EQ(positionName(c.code), c.name);
        EXPECT_EQ(gravityFor(c.code), c.gravity) << c.code;
    }
}

TEST(Marker, SurvivesJsonWithKeysOfOthers)
{
    Marker m{
        .id = "m1", .scan_id = "s1", .position_mm = {1.5, -2, 3}, .color = MarkerColor::green, .note = "Größe 5 мм"};
    m.extra["size_mm"] = 5.5;
    const Marker back = markerFromJson(toJson(m));
    EXPECT_EQ(back.position_mm, m.position_mm);
    EXPECT_EQ(back.color, MarkerColor::green);
    EXPECT_EQ(back.note, m.note);
    EXPECT_EQ(back.extra, m.extra);
}

TEST(Marker, RefusesWhatIsNone)
{
    EXPECT_THROW(markerFromJson({{"color", "red"}}), Error);
    EXPECT_THROW(markerFromJson({{"color", "blue"}, {"position_mm", {1, 2, 3}}}), Error);
    EXPECT_THROW(markerFromJson({{"color", "red"}, {"position_mm", {1, 2}}}), Error);
    EXPECT_THROW(markerFromJson({{"color", "red"}, {"position_mm", "1,2,3"}}), Error);
}

}  // namespace
}  // namespace vicon
