#pragma once

// How far two lines through a colon run together.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "vicon/core/skeleton.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// The line with a point every millimetre or so, so that each counts as much as any other.
inline Skeleton evenly(const Skeleton& line)
{
    const int count = int(std::lround(line.length_mm()));
    SkeletonPiece piece{.bridge = false, .points = {}};
    for (int n = 0; n <= count; ++n)
        piece.points.push_back(line.at(line.length_mm() * n / count));
    return Skeleton{{piece}};
}

inline std::vector<SkeletonPoint> pointsOf(const Skeleton& skeleton)
{
    std::vector<SkeletonPoint> points;
    for (const SkeletonPiece& piece : skeleton.pieces)
        points.insert(points.end(), piece.points.begin(), piece.points.end());
    return points;
}

/// Gives each point of a line the lumen's radius there: the largest distance to the wall in the voxels around it, since
/// a line may run a voxel beside the middle.
inline void measureRadii(const FieldVolume& wall_mm, Skeleton& line)
{
    for (SkeletonPiece& piece : line.pieces)
        for (SkeletonPoint& p : piece.points) {
            const Index3 v = wall_mm.grid.indexAt(p.position_mm);
            p.radius_mm = 0;
            for (int k = -1; k <= 1; ++k)
                for (int j = -1; j <= 1; ++j)
                    for (int i = -1; i <= 1; ++i)
                        p.radius_mm = std::max(p.radius_mm, double(wall_mm.valueOr({v.i + i, v.j + j, v.k + k}, 0)));
        }
}

struct Overlap {
    double whole = 0;     ///< Schaap's OV: share of both lines' points within the local radius of the other line
    double between = 0;   ///< the same from where the two first meet to where they last do
    double given_mm = 0;  ///< longer stretch of the given line before or after that
    double found_mm = 0;  ///< the same of the found line
    double jump_mm = 0;   ///< most that the given line advances while the found one goes 10 mm: a short cut
    double back_mm = 0;   ///< most that it goes back
    double mean_mm = 0;   ///< from the found line to the given one; it and the two above: where they run together
};

/// A line's points: their stations and whether they lie at the other line.
struct Followed {
    std::vector<double> station_mm;
    std::vector<bool> covered;
    std::size_t begin = 0, end = 0;  ///< from the first to after the last covered one

    void add(double station, bool is_covered)
    {
        station_mm.push_back(station);
        covered.push_back(is_covered);
    }
    void trim()
    {
        begin = std::size_t(std::find(covered.begin(), covered.end(), true) - covered.begin());
        end = covered.size() - std::size_t(std::find(covered.rbegin(), covered.rend(), true) - covered.rbegin());
    }
    double loose_mm() const
    {
        return std::max(station_mm.at(begin) - station_mm.front(), station_mm.back() - station_mm.at(end - 1));
    }
    double count() const { return double(std::count(covered.begin(), covered.end(), true)); }
};

/// @param given with radii, @param found points about 1 mm apart
inline Overlap compare(const Skeleton& given, const Skeleton& found)
{
    Followed ours, theirs;
    for (const SkeletonPoint& p : pointsOf(given))
        theirs.add(p.station_mm, found.nearest(p.position_mm).distance_mm <= p.radius_mm);
    std::vector<SkeletonFoot> feet;
    for (const SkeletonPoint& p : pointsOf(found)) {
        feet.push_back(given.nearest(p.position_mm));
        ours.add(p.station_mm, feet.back().distance_mm <= given.at(feet.back().station_mm).radius_mm);
    }
    ours.trim();
    theirs.trim();
    const double covered = ours.count() + theirs.count();
    Overlap overlap{.whole = covered / double(ours.covered.size() + theirs.covered.size()),
                    .between = covered / double(ours.end - ours.begin + theirs.end - theirs.begin),
                    .given_mm = theirs.loose_mm(),
                    .found_mm = ours.loose_mm()};
    for (std::size_t n = ours.begin; n < ours.end; ++n) {
        overlap.mean_mm += feet[n].distance_mm / double(ours.end - ours.begin);
        if (n + 10 < ours.end && ours.covered[n] && ours.covered[n + 10]) {
            const double on_mm = feet[n + 10].station_mm - feet[n].station_mm;
            overlap.jump_mm = std::max(overlap.jump_mm, on_mm);
            overlap.back_mm = std::max(overlap.back_mm, -on_mm);
        }
    }
    return overlap;
}

inline void print(const char* shape, const char* ends, const Overlap& overlap, double found_mm, double given_mm)
{
    std::printf(
        "%s, %s ends: OV %.4f in all, %.4f where the lines run together; loose ends: given %.1f mm, found %.1f mm; in "
        "10 mm %.1f mm on, %.1f mm back; mean distance %.2f mm; length %.0f mm (given line %.0f)\n",
        shape, ends, overlap.whole, overlap.between, overlap.given_mm, overlap.found_mm, overlap.jump_mm,
        overlap.back_mm, overlap.mean_mm, found_mm, given_mm);
}

}  // namespace vicon::steps
