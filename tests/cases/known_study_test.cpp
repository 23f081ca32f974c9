#include "vicon/cases/known_study.h"

#include <gtest/gtest.h>

namespace vicon {
namespace {

TEST(KnownStudy, FillsInWhatWasNotSaidAndLeavesWhatWas)
{
    const KnownStudy known{.indication = "positive FIT",
                           .technique = "supine (120 kV)",
                           .dose_mgy_cm = 310.5,
                           .reading_minutes = 8,
                           .coverage_percent = 94.1,
                           .fluid = "supine 212 ml (12 %)"};
    Assessment said;
    said.indication = "bleeding";
    said.reading_minutes = 12;
    fillIn(said, known);
    EXPECT_EQ(said.indication, "bleeding");
    EXPECT_EQ(said.technique, "supine (120 kV)");
    EXPECT_EQ(said.dose_mgy_cm, 310.5);
    EXPECT_EQ(said.reading_minutes, 12);
    EXPECT_EQ(said.coverage_percent, 94.1);
    EXPECT_FALSE(said.preparation || said.tagging) << "the fluid helps to judge them, and does not";
    const Assessment before = said;
    fillIn(said, {});
    EXPECT_EQ(toJson(said), toJson(before));
}

}  // namespace
}  // namespace vicon
