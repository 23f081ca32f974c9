#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "subdivision_checks.h"
#include "vicon/steps/cells.h"

namespace vicon::steps {
namespace {

SubdivideOptions thesis(int segments)
{
    return {.method = SubdivideMethod::thesis, .segments = segments};
}

TEST(ThesisSubdivision, MeetsTheMandatoryCriteriaWithEveryOption)
{
    struct Case {
        SegmentSize size;
        PortalEffectiveness effectiveness;
        SubdivideApproach approach;
        PlaneDirections planes;
    };
    using enum PortalEffectiveness;
    using enum SubdivideApproach;
    using enum PlaneDirections;
    for (const Case& c :
         {Case{SegmentSize::surface, gate_ratio, local, axis}, Case{SegmentSize::inside, tangent, local, axis},
          Case{SegmentSize::triangles, portal_size, local, axis}, Case{SegmentSize::surface, gate_ratio, global, axis},
          Case{SegmentSize::inside, gate_ratio, local, oblique},
          Case{SegmentSize::triangles, gate_ratio, global, oblique}})
        for (const Lumen& lumen : {bentTube(), bridgedTubes()}) {
            SubdivideOptions options = thesis(6);
            options.size = c.size;
            options.effectiveness = c.effectiveness;
            options.approach = c.approach;
            options.planes = c.planes;
            const Subdivided divided = divide(lumen, options);
            expectPartition(lumen, divided);
            expectGatesEnclose(divided);
            EXPECT_NEAR(double(divided.description.segments.size()), 6, 3) << nameIn(kSegmentSizeNames, c.size);
        }
}

TEST(ThesisSubdivision, PutsSquareGatesAcrossAStraightTubeAtEqualSizes)
{
    const Grid grid{.size = {28, 28, 150}};
    const Skeleton skeleton{{pieceThrough({{14, 14, 5}, {14, 14, 145}}, 10)}};
    const Lumen lumen{
        maskOf(grid, [](Point3 p) { return std::hypot(p.x - 14, p.y - 14) < 10 && p.z > 4.5 && p.z < 144.5; }),
        skeleton};
    for (const SubdivideApproach approach : {SubdivideApproach::local, SubdivideApproach::global}) {
        SubdivideOptions options = thesis(5);
        options.approach = approach;
        const Subdivided divided = divide(lumen, options);
        ASSERT_EQ(divided.description.portals.size() + 1, divided.description.segments.size());
        for (const auto& portal : divided.description.portals) {
            EXPECT_NEAR(portal.normal.z, 1, 1e-9);
            EXPECT_NEAR(distance(portal.gate_mm[0], portal.gate_mm[1]), distance(portal.gate_mm[1], portal.gate_mm[2]),
                        1.5);
            EXPECT_NEAR(distance(portal.box_mm[0], portal.box_mm[4]), 2 * std::sqrt(3.0), 1e-6);
        }
        const double average = double(std::count(lumen.inside.voxels.begin(), lumen.inside.voxels.end(), kGas)) / 5;
        for (std::size_t n = 0; n + 1 < divided.description.segments.size(); ++n)
            EXPECT_NEAR(double(divided.description.segments[n].inside_voxels), average, 0.35 * average)
                << nameIn(kSubdivideApproachNames, approach);
    }
}

TEST(ThesisSubdivision, MakesAsManySegmentsAsTheLengthOfOneGives)
{
    const Lumen lumen = bentTube();
    const double total_mm = lumen.skeleton.pieces.back().points.back().station_mm;
    for (const int segments : {4, 8}) {
        SubdivideOptions options = thesis(0);
        options.length_mm = total_mm / segments;
        EXPECT_NEAR(double(divide(lumen, options).description.segments.size()), segments, 2);
    }
}

TEST(ThesisSubdivision, ObliquePlanesLieAcrossAnObliqueTube)
{
    const Grid grid{.size = {100, 80, 60}};
    const Skeleton skeleton{{pieceThrough({{12, 12, 12}, {88, 66, 46}}, 8)}};
    const Lumen lumen{tubeAlong(grid, skeleton, 8), skeleton};
    const Vector3 along = normalized(Vector3{76, 54, 34});
    SubdivideOptions options = thesis(4);
    options.planes = PlaneDirections::oblique;
    const Subdivided divided = divide(lumen, options);
    ASSERT_GE(divided.description.portals.size(), 2U);
    for (const auto& portal : divided.description.portals)
        EXPECT_GT(dot(portal.normal, along), std::cos(5 * M_PI / 180));
}

TEST(ThesisSubdivision, GoesOnFromTheEarlierCandidateItWentBackTo)
{
    // A tube too oblique for square gates: only corrections to the best earlier candidate cut it.
    const Grid grid{.size = {100, 30, 100}};
    const Skeleton skeleton{{pieceThrough({{12, 14, 12}, {88, 14, 85}}, 8)}};
    SubdivideOptions options = thesis(5);
    options.gate_ratio_low = 0.99;
    options.gate_ratio_high = 1.01;
    const Subdivided divided = divide({tubeAlong(grid, skeleton, 8), skeleton}, options);
    EXPECT_GE(divided.description.segments.size(), 3U);
    double station = -1;
    for (const auto& segment : divided.description.segments) {
        EXPECT_GT(segment.to_station_mm, segment.from_station_mm);
        EXPECT_GE(segment.from_station_mm, station);
        station = segment.to_station_mm - 1e-9;
    }
}

/// A tube that widens fourfold: equal numbers of inside voxels are far from equal numbers of triangles.
Lumen funnel()
{
    const auto radius = [](double z) { return 5 + 15 * z / 180; };
    return {maskOf(Grid{.size = {50, 50, 190}},
                   [&](Point3 p) { return p.z > 4 && p.z < 184 && std::hypot(p.x - 25, p.y - 25) < radius(p.z); }),
            {{pieceThrough({{25, 25, 6}, {25, 25, 180}}, 8)}}};
}

Subdivided dividedBy(const Lumen& lumen, SegmentSize size)
{
    SubdivideOptions options = thesis(6);
    options.size = size;
    options.approach = SubdivideApproach::global;
    return divide(lumen, options);
}

TEST(ThesisSubdivision, BalancesTrianglesBetterWhenItCountsThem)
{
    const Lumen lumen = funnel();
    HuVolume hu(lumen.inside.grid);
    std::transform(lumen.inside.voxels.begin(), lumen.inside.voxels.end(), hu.voxels.begin(),
                   [](std::uint8_t v) { return std::int16_t(v ? -1000 : 40); });
    const auto spread = [&](SegmentSize size) {
        Subdivided divided = dividedBy(lumen, size);
        NoProgress quiet;
        countTriangles(extractCells(hu, lumen.inside, divided.segments, {}, quiet), divided.description);
        const auto& s = divided.description.statistics;
        return s["triangles_standard_deviation"].get<double>() / s["triangles_average"].get<double>();
    };
    EXPECT_LT(spread(SegmentSize::triangles), 0.7 * spread(SegmentSize::inside));
}

TEST(ThesisSubdivision, BalancesWhatMeasuresASegmentsSize)
{
    const Lumen lumen = funnel();
    const Grid& grid = lumen.inside.grid;
    const auto isSurface = [&](Index3 v) {
        for (const Index3 w : {Index3{v.i - 1, v.j, v.k},
                               {v.i + 1, v.j, v.k},
                               {v.i, v.j - 1, v.k},
                               {v.i, v.j + 1, v.k},
                               {v.i, v.j, v.k - 1},
                               {v.i, v.j, v.k + 1}})
            if (lumen.inside.valueOr(w, kOutside) == kOutside)
                return true;
        return false;
    };
    const auto spread = [&](SegmentSize size, bool of_surface) {
        const Subdivided divided = dividedBy(lumen, size);
        std::vector<double> count(divided.description.segments.size(), 0);
        for (std::size_t n = 0; n < grid.voxelCount(); ++n)
            if (divided.segments.voxels[n] && (!of_surface || isSurface(grid.indexOf(n))))
                ++count[std::size_t(divided.segments.voxels[n] - 1)];
        return *std::max_element(count.begin(), count.end()) / *std::min_element(count.begin(), count.end());
    };
    EXPECT_LT(spread(SegmentSize::surface, true), 1.3);
    EXPECT_GT(spread(SegmentSize::inside, true), 1.5);
    EXPECT_LT(spread(SegmentSize::inside, false), 1.3);
    EXPECT_GT(spread(SegmentSize::surface, false), 1.5);
}

TEST(ThesisSubdivision, DoesNotDependOnTheNumberOfThreads)
{
    SubdivideOptions options = thesis(6);
    options.approach = SubdivideApproach::global;
    const Lumen lumen = bentTube();
    const Subdivided both = divide(lumen, options);
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(divide(lumen, options).segments.voxels, both.segments.voxels);
}

}  // namespace
}  // namespace vicon::steps
