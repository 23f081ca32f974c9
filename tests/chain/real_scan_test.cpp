// What segmentation and skeleton make of the real scan: not exact, but nothing of it may change unnoticed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "chain.h"
#include "vicon/cases/records.h"
#include "vicon/ingest/load_scan.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/skeleton.h"
#include "vicon/support/support.h"

namespace vicon::test {
namespace {

/// Volumes of the 6-connected pieces of one label, in ml, largest first.
std::vector<double> piecesOf(const InsideVolume& inside, std::uint8_t label)
{
    const Grid& grid = inside.grid;
    const double voxel_ml = grid.spacing_mm[0] * grid.spacing_mm[1] * grid.spacing_mm[2] / 1000;
    std::vector<bool> visited(inside.voxels.size(), false);
    std::vector<double> pieces;
    std::vector<std::size_t> stack;
    for (std::size_t start = 0; start < inside.voxels.size(); ++start) {
        if (visited[start] || inside.voxels[start] != label)
            continue;
        std::size_t count = 0;
        visited[start] = true;
        stack.push_back(start);
        while (!stack.empty()) {
            const Index3 v = grid.indexOf(stack.back());
            stack.pop_back();
            ++count;
            for (const auto& [i, j, k] :
                 {std::array{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
                const Index3 w{v.i + i, v.j + j, v.k + k};
                if (!grid.contains(w) || visited[grid.offset(w)] || inside.at(w) != label)
                    continue;
                visited[grid.offset(w)] = true;
                stack.push_back(grid.offset(w));
            }
        }
        pieces.push_back(double(count) * voxel_ml);
    }
    std::sort(pieces.rbegin(), pieces.rend());
    return pieces;
}

/// One of 300 voxels beside the wall is outside.
InsideVolume withRoughWall(InsideVolume inside)
{
    std::mt19937 random(5);
    std::vector<std::size_t> taken;
    for (std::size_t n = 1; n + 1 < inside.voxels.size(); ++n)
        if (inside.voxels[n] && (!inside.voxels[n - 1] || !inside.voxels[n + 1]) && random() % 300 == 0)
            taken.push_back(n);
    for (const std::size_t n : taken)
        inside.voxels[n] = kOutside;
    return inside;
}

double nearestStation(const Skeleton& curve, Point3 p)
{
    double station_mm = 0, least_mm = std::numeric_limits<double>::infinity();
    for (const SkeletonPoint& one : curve.pieces.at(0).points)
        if (const double away_mm = distance(one.position_mm, p); away_mm < least_mm) {
            least_mm = away_mm;
            station_mm = one.station_mm;
        }
    return station_mm;
}

TEST(RealScan, IsOneColonFromRectumToCaecumWithoutABridge)
{
    VICON_NEEDS_DATA("ctc-prone");
    NoProgress quiet;
    HuVolume acquired = ingest::loadScan(support::sharedData("ctc-prone"), {}, quiet);
    const HuVolume volume = steps::resample(std::move(acquired), {}, quiet);
    const steps::Segmentation found = steps::segmentColon(volume, gravityFor("HFP"), {}, quiet);
    EXPECT_GT(found.confidence, 0.5);
    ASSERT_EQ(found.plan.pieces.size(), 1U);
    EXPECT_TRUE(found.plan.bridges.empty());

    // The gas lies in three pieces of about 2486, 281 and 184 ml, joined through pools; nothing of lungs (402 and 312
    // ml) or stomach. Those figures count what lies below -800 HU; the lumen ends half-way to the wall.
    const std::vector<double> gas_ml = piecesOf(found.inside, kGas);
    ASSERT_GE(gas_ml.size(), 3U);
    EXPECT_NEAR(gas_ml[0], 2486, 0.12 * 2486);
    EXPECT_NEAR(gas_ml[1], 281, 0.12 * 281);
    EXPECT_NEAR(gas_ml[2], 184, 0.12 * 184);
    double rest_ml = 0;
    for (std::size_t n = 3; n < gas_ml.size(); ++n)
        rest_ml += gas_ml[n];
    EXPECT_LT(rest_ml, 40);
    const std::vector<double> fluid_ml = piecesOf(found.inside, kFluid);
    ASSERT_FALSE(fluid_ml.empty());
    EXPECT_GT(fluid_ml[0], 20);

    const steps::SkeletonResult skeleton = steps::findSkeleton(found.inside, found.plan, {}, quiet);
    ASSERT_EQ(skeleton.curve.pieces.size(), 1U);
    EXPECT_FALSE(skeleton.curve.pieces[0].bridge);
    EXPECT_NEAR(skeleton.curve.length_mm(), 2014, 0.01 * 2014);
    const auto& points = skeleton.curve.pieces[0].points;
    const Point3 rectum = points.front().position_mm, caecum = points.back().position_mm;
    const Point3 middle =
        volume.grid.pointAt(Index3{volume.grid.size[0] / 2, volume.grid.size[1] / 2, volume.grid.size[2] / 2});
    // Read off sagittal slices: the rectal tube comes in through the anal canal here, at the front of the ampulla.
    const Point3 anal_canal{-9, -22, -188};
    EXPECT_LT(distance(rectum, anal_canal), 36) << "the curve begins one radius within the lumen,";
    for (const SkeletonPoint& p : points) {
        EXPECT_GT(p.position_mm.z, rectum.z - 5) << "at its lowest part";
        EXPECT_TRUE(found.inside.valueOr(found.inside.grid.indexAt(p.position_mm), kOutside) != kOutside)
            << "at " << p.station_mm;
    }
    EXPECT_LT(caecum.x, middle.x - 30) << "the caecum on the patient's right";

    // A few of the wall's voxels, as noise moves them, move no station by much.
    const Skeleton again = steps::findSkeleton(withRoughWall(found.inside), found.plan, {}, quiet).curve;
    EXPECT_NEAR(again.length_mm(), skeleton.curve.length_mm(), 8);
    for (std::size_t n = 50; n + 50 < points.size(); n += 50)
        EXPECT_NEAR(nearestStation(again, points[n].position_mm), points[n].station_mm, 8) << points[n].station_mm;
}

}  // namespace
}  // namespace vicon::test
