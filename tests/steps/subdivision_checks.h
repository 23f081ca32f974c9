#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "field_shapes.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/steps/subdivide.h"
#include "vicon/support/support.h"

namespace vicon::steps {

struct Lumen {
    InsideVolume inside;
    Skeleton skeleton;
};

inline InsideVolume tubeAlong(const Grid& grid, const Skeleton& skeleton, double radius_mm)
{
    return maskOf(grid, [&](Point3 p) {
        for (const SkeletonPiece& piece : skeleton.pieces)
            if (!piece.bridge && Skeleton{{piece}}.nearest(p).distance_mm < radius_mm)
                return true;
        return false;
    });
}

/// A tube that bends twice, passing itself at a distance.
inline Lumen bentTube()
{
    const Grid grid{.size = {110, 70, 40}, .spacing_mm = {1, 1, 1}};
    Skeleton skeleton{{pieceThrough({{12, 15, 18}, {90, 15, 18}, {95, 50, 20}, {15, 52, 20}}, 9)}};
    return {tubeAlong(grid, skeleton, 9), skeleton};
}

/// Two tubes with a bridge between them; both are 26-connected to nothing else.
inline Lumen bridgedTubes()
{
    const Grid grid{.size = {120, 30, 30}};
    Skeleton skeleton;
    skeleton.pieces.push_back(pieceThrough({{10, 15, 15}, {48, 15, 15}}, 8));
    skeleton.pieces.push_back(pieceThrough({{48, 15, 15}, {72, 15, 15}}, 0, 38, true));
    skeleton.pieces.push_back(pieceThrough({{72, 15, 15}, {108, 15, 15}}, 8, 62));
    return {tubeAlong(grid, skeleton, 8), skeleton};
}

inline Lumen realColon(const std::string& name)
{
    return {scan_files::readVolume<std::uint8_t>(support::sharedData("shapes/" + name + ".mha")),
            readCentreline(support::sharedData("shapes/" + name + "_centerline.csv"))};
}

inline Subdivided divide(const Lumen& lumen, const SubdivideOptions& options = {})
{
    NoProgress no_progress;
    return subdivide(lumen.inside, lumen.skeleton, voxelsAlong(lumen.skeleton, lumen.inside), options, no_progress);
}

/// Number of 26-connected components of each segment.
inline std::map<int, int> componentsOf(const SegmentVolume& segments)
{
    std::map<int, int> count;
    std::vector<bool> seen(segments.voxels.size());
    for (std::size_t start = 0; start < segments.voxels.size(); ++start) {
        if (!segments.voxels[start] || seen[start])
            continue;
        ++count[segments.voxels[start]];
        std::vector<std::size_t> queue{start};
        seen[start] = true;
        while (!queue.empty()) {
            const Index3 v = segments.grid.indexOf(queue.back());
            queue.pop_back();
            for (int n = 0; n < 27; ++n) {
                const Index3 w{v.i + n % 3 - 1, v.j + n / 3 % 3 - 1, v.k + n / 9 - 1};
                if (!segments.grid.contains(w) || segments.at(w) != segments.voxels[start])
                    continue;
                if (const std::size_t o = segments.grid.offset(w); !seen[o]) {
                    seen[o] = true;
                    queue.push_back(o);
                }
            }
        }
    }
    return count;
}

inline void expectPartition(const Lumen& lumen, const Subdivided& divided)
{
    ASSERT_EQ(divided.segments.grid, lumen.inside.grid);
    std::vector<std::size_t> voxels(divided.description.segments.size() + 1, 0);
    for (std::size_t n = 0; n < lumen.inside.voxels.size(); ++n) {
        ASSERT_EQ(divided.segments.voxels[n] != 0, lumen.inside.voxels[n] != kOutside);
        ASSERT_LT(divided.segments.voxels[n], voxels.size());
        ++voxels[divided.segments.voxels[n]];
    }
    for (const auto& [segment, count] : componentsOf(divided.segments))
        EXPECT_EQ(count, 1) << "segment " << segment << " is not connected";
    double station = -1;
    for (std::size_t n = 0; n < divided.description.segments.size(); ++n) {
        const auto& info = divided.description.segments[n];
        EXPECT_EQ(info.number, int(n + 1));
        EXPECT_EQ(info.inside_voxels, voxels[n + 1]);
        EXPECT_GT(info.inside_voxels, 0U);
        EXPECT_GE(info.from_station_mm, station);
        station = info.from_station_mm;
    }
}

/// Coordinates of `p` in the box's own axes, each 0..1 inside.
inline std::array<double, 3> inBox(const std::array<Point3, 8>& box, Point3 p)
{
    std::array<double, 3> c{};
    const std::array<Vector3, 3> edge{box[1] - box[0], box[3] - box[0], box[4] - box[0]};
    for (std::size_t d = 0; d < 3; ++d)
        c[d] = dot(p - box[0], edge[d]) / dot(edge[d], edge[d]);
    return c;
}

/// Every pair of touching voxels of two segments lies in the box of exactly one portal, with a voxel diagonal to spare.
inline void expectGatesEnclose(const Subdivided& divided)
{
    const Grid& grid = divided.segments.grid;
    const double diagonal_mm = std::hypot(grid.spacing_mm[0], grid.spacing_mm[1], grid.spacing_mm[2]);
    std::map<std::pair<int, int>, const Portal*> portals;
    for (const auto& portal : divided.description.portals) {
        EXPECT_LT(portal.segment_a, portal.segment_b);
        EXPECT_TRUE(portals.emplace(std::pair(portal.segment_a, portal.segment_b), &portal).second);
        EXPECT_NEAR(length(portal.normal), 1, 1e-9);
        EXPECT_GT(dot(portal.box_mm[4] - portal.box_mm[0], portal.normal), 0);
    }
    std::set<std::pair<int, int>> touching;
    for (std::size_t n = 0; n < divided.segments.voxels.size(); ++n) {
        if (!divided.segments.voxels[n])
            continue;
        const Index3 v = grid.indexOf(n);
        for (int m = 14; m < 27; ++m) {
            const Index3 w{v.i + m % 3 - 1, v.j + m / 3 % 3 - 1, v.k + m / 9 - 1};
            const int a = divided.segments.voxels[n], b = divided.segments.valueOr(w, 0);
            if (!b || a == b)
                continue;
            const std::pair key(std::min(a, b), std::max(a, b));
            touching.insert(key);
            ASSERT_TRUE(portals.contains(key)) << a << " " << b;
            const auto& box = portals[key]->box_mm;
            const Point3 middle = interpolate(grid.pointAt(v), grid.pointAt(w), 0.5);
            const std::array<double, 3> extent{distance(box[0], box[1]), distance(box[0], box[3]),
                                               distance(box[0], box[4])};
            const auto c = inBox(box, middle);
            for (std::size_t d = 0; d < 3; ++d) {
                ASSERT_GE(c[d] * extent[d], diagonal_mm - 1e-6);
                ASSERT_LE(c[d] * extent[d], extent[d] - diagonal_mm + 1e-6);
            }
        }
    }
    EXPECT_EQ(touching.size(), portals.size());
}

}  // namespace vicon::steps
