#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "vicon/core/skeleton.h"
#include "vicon/core/volume.h"
#include "vicon/scan_files/skeleton_file.h"

namespace vicon::steps {

/// The mask of all voxels whose centre satisfies `holds`.
inline InsideVolume maskOf(const Grid& grid, const std::function<bool(Point3)>& holds)
{
    InsideVolume mask(grid);
    for (std::size_t n = 0; n < grid.voxelCount(); ++n)
        mask.voxels[n] = holds(grid.pointAt(grid.indexOf(n))) ? kGas : kOutside;
    return mask;
}

/// A piece of curve through points, continuing at a station.
inline SkeletonPiece pieceThrough(const std::vector<Point3>& points, double radius_mm, double from_station_mm = 0,
                                  bool bridge = false)
{
    SkeletonPiece piece{.bridge = bridge, .points = {}};
    double station = from_station_mm;
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (n > 0)
            station += distance(points[n - 1], points[n]);
        piece.points.push_back({points[n], station, radius_mm});
    }
    return piece;
}

/// The voxels along the curve's connected pieces, 26-connected where the curve stays inside.
inline SkeletonVoxels voxelsAlong(const Skeleton& skeleton, const InsideVolume& inside)
{
    SkeletonVoxels paths;
    for (const SkeletonPiece& piece : skeleton.pieces) {
        if (piece.bridge)
            continue;
        std::vector<Point3> path;
        Index3 last{-1, -1, -1};
        for (double s = piece.points.front().station_mm; s <= piece.points.back().station_mm; s += 0.1) {
            const Index3 v = inside.grid.indexAt(skeleton.at(s).position_mm);
            if (v == last || !inside.valueOr(v, kOutside))
                continue;
            path.push_back(inside.grid.pointAt(v));
            last = v;
        }
        paths.push_back(path);
    }
    return paths;
}

/// A centreline of ../shared/data/shapes: lines of x,y,z in LPS mm below a title line. Points nearer than 1 mm to the
/// one before are left out.
inline Skeleton readCentreline(const std::filesystem::path& csv)
{
    std::ifstream in(csv);
    std::vector<Point3> points;
    for (std::string line; std::getline(in, line);) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream fields(line);
        Point3 p;
        if (fields >> p.x >> p.y >> p.z && (points.empty() || distance(points.back(), p) >= 1))
            points.push_back(p);
    }
    return Skeleton{{pieceThrough(points, 5)}};
}

}  // namespace vicon::steps
