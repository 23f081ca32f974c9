#include "vicon/core/geometry.h"

#include <gtest/gtest.h>

namespace vicon {
namespace {

TEST(Grid, MapsIndicesToPointsAndBackInEveryOrientation)
{
    const Vector3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int permutation = 0; permutation < 6; ++permutation)
        for (int signs = 0; signs < 8; ++signs) {
            static constexpr int kOrder[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
            Grid grid{.size = {7, 8, 9}, .origin_mm = {10, -20, 30}, .spacing_mm = {0.5, 0.7, 1.1}};
            for (std::size_t a = 0; a < 3; ++a)
                grid.axis[a] = axes[kOrder[permutation][a]] * (signs >> a & 1 ? -1.0 : 1.0);
            const Index3 v{3, 5, 8};
            EXPECT_EQ(grid.indexAt(grid.pointAt(v)), v);
            EXPECT_EQ(grid.indexOf(grid.offset(v)), v);
            const Point3 next = grid.pointAt(Index3{4, 5, 8});
            EXPECT_NEAR(distance(next, grid.pointAt(v) + grid.axis[0] * 0.5), 0, 1e-12);
        }
}

TEST(Grid, KnowsWhatLiesOutside)
{
    const Grid grid{.size = {2, 2, 2}};
    EXPECT_TRUE(grid.contains({1, 1, 1}));
    for (const Index3 v : {Index3{2, 0, 0}, Index3{0, -1, 0}, Index3{0, 0, 2}})
        EXPECT_FALSE(grid.contains(v));
}

}  // namespace
}  // namespace vicon
