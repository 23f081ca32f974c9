#include "vicon/cases/station_map.h"

#include <gmock/gmock.h>

namespace vicon {
namespace {

using testing::ElementsAre;

TEST(ColonProfile, IsReadFromCentrelineAndQuality)
{
    Skeleton skeleton{{SkeletonPiece{.points = {{{0, 0, 0}, 0, 10}, {{2, 0, 0}, 2, 14}}},
                       SkeletonPiece{.bridge = true, .points = {{{2, 0, 0}, 2, 14}, {{4, 0, 0}, 4, 2}}},
                       SkeletonPiece{.points = {{{4, 0, 0}, 4, 2}, {{6, 0, 0}, 6, 4}}}}};
    LumenAlong along;
    along.step_mm = 2;
    along.radius_mm = {10, 20, 30};
    along.collapsed = {{5, 6}};
    const ColonProfile profile = profileOf(skeleton, {}, along);
    EXPECT_EQ(profile.length_mm, 6);
    EXPECT_THAT(profile.clearance_mm, ElementsAre(10, 12, 14, 8, 2, 3, 4));
    EXPECT_THAT(profile.width_mm, ElementsAre(10, 10, 15, 20, 25, 30, 30)) << "each is that of the middle of its step";
    ASSERT_EQ(profile.bridges.size(), 2U);
    EXPECT_EQ(profile.bridges[0].from_mm, 2);
    EXPECT_EQ(profile.bridges[0].to_mm, 4);
    EXPECT_EQ(profile.bridges[1].from_mm, 5);
    EXPECT_TRUE(profileOf({}, {}, along).clearance_mm.empty());
}

TEST(StationMap, ReadTheOtherWayRisesWhereItStoodStill)
{
    const StationMap map{MapSource::wall, 30, 20, {0, 10, 20, 30}, {{0, 0, 2}, {8, 5, 9}, {8, 4, 9}, {20, 15, 20}}};
    const StationMap back = map.reversed();
    ASSERT_FALSE(back.from_mm.empty());
    EXPECT_EQ(back.from_mm.back(), 20);
    EXPECT_NEAR(back.at(20).station_mm, 30, 1e-6);
    for (double there = 1; there <= 20; there += 1) {
        EXPECT_GE(back.at(there).station_mm, back.at(there - 1).station_mm);
        EXPECT_GE(back.at(there).least_mm, back.at(there - 1).least_mm);
        EXPECT_GE(back.at(there).most_mm, back.at(there - 1).most_mm);
        EXPECT_LE(back.at(there).least_mm, back.at(there).most_mm);
    }
}

}  // namespace
}  // namespace vicon
