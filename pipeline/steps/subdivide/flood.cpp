#include "subdivide/flood.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/lumen_front.h"
#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

using Labels = LumenFront::Labels;

// By how much the front of a path's voxel runs ahead of the next one's: the flood sweeps along the colon, and takes
// half the time of one that rises everywhere at once. Chosen on the 512 x 512 x 430 phantom; 0.03 to 0.3 are as good.
constexpr float kAhead_voxels = 0.1F;

std::uint16_t newLabel(Labelling& labelling, LabelledPiece piece)
{
    if (labelling.pieces.size() >= std::numeric_limits<std::uint16_t>::max())
        throw Error(ErrorCode::bad_input, "the lumen falls into more than 65535 segments", {},
                    "raise subdivide.length_mm, or look at the segmentation");
    labelling.pieces.push_back(piece);
    return std::uint16_t(labelling.pieces.size());
}

Path pathAlong(const InsideVolume& inside, const Skeleton& skeleton, int piece, const std::vector<Point3>& points)
{
    const auto& curve = skeleton.pieces[std::size_t(piece)].points;
    const double from = curve.front().station_mm, to = curve.back().station_mm;
    Path path{.piece = piece, .voxels = {}};
    double station = from;
    for (const Point3& point : points) {
        const Index3 v = inside.grid.indexAt(point);
        if (inside.valueOr(v, kOutside) == kOutside)
            continue;
        station = std::max(station, skeleton.nearest(point, from, to).station_mm);
        path.voxels.push_back({inside.grid.offset(v), std::min(station, to)});
    }
    if (path.voxels.empty())
        path.voxels.push_back({nearestInside(inside, curve.front().position_mm), from});
    return path;
}

/// Cuts a path into pieces of about `length_mm`, and appends the label of each of its voxels.
void cutPath(std::vector<std::uint16_t>& label_of, Labelling& labelling, const Skeleton& skeleton, const Path& path,
             double length_mm)
{
    const auto& curve = skeleton.pieces[std::size_t(path.piece)].points;
    const double from = curve.front().station_mm, length = curve.back().station_mm - from;
    const int cuts = std::max(1, int(std::lround(length / length_mm)));
    std::uint16_t first = 0;
    for (int n = 0; n < cuts; ++n) {
        const auto label = newLabel(labelling, {from + length * n / cuts, from + length * (n + 1) / cuts, path.piece});
        first = n == 0 ? label : first;
    }
    for (const PathVoxel& v : path.voxels) {
        const int n = std::clamp(int(cuts * (v.station_mm - from) / std::max(length, 1e-9)), 0, cuts - 1);
        label_of.push_back(std::uint16_t(first + n));
    }
}

/// The flood from these voxels, each of which has its place in the order as label.
PathFlood floodFrom(const InsideVolume& inside, std::vector<std::uint32_t> seeds)
{
    PathFlood flood{std::move(seeds), {}, {}};
    const auto& spacing_mm = inside.grid.spacing_mm;
    const auto next = [&] {
        const std::size_t label = flood.seeds.size() + flood.loose.size();
        if (label > std::numeric_limits<std::uint16_t>::max())
            throw Error(ErrorCode::bad_input, "the lumen's path and loose parts are more than 65535", {},
                        "raise resample.spacing_mm, or look at the segmentation");
        return std::uint16_t(label);
    };
    next();
    LumenFront front(inside);
    for (std::size_t n = 0; n < flood.seeds.size(); ++n)
        front.seed(flood.seeds[n], 0, std::uint16_t(n + 1));
    front.runAheadByLabel(kAhead_voxels * float(*std::min_element(spacing_mm.begin(), spacing_mm.end())));
    front.run(Labels::adopt);
    front.runOverCorners(Labels::adopt);
    for (const std::uint32_t voxel : front.unreached()) {
        if (front.timeAt(voxel) < LumenFront::kUnreached)
            continue;
        flood.loose.push_back(voxel);
        const std::uint16_t label = next();
        for (const std::uint32_t v : front.componentOf(voxel))
            front.seed(v, 0, label);
    }
    flood.label = front.labels();
    return flood;
}

}  // namespace

std::vector<Path> pathsOf(const InsideVolume& inside, const Skeleton& skeleton, const SkeletonVoxels& voxels)
{
    std::vector<Path> paths;
    std::size_t next = 0;
    for (std::size_t n = 0; n < skeleton.pieces.size(); ++n) {
        if (skeleton.pieces[n].bridge)
            continue;
        if (next >= voxels.size())
            throw Error(ErrorCode::bad_input, "the skeleton has more connected pieces than voxel paths", {},
                        "run 'vicon work' to make the skeleton anew");
        paths.push_back(pathAlong(inside, skeleton, int(n), voxels[next++]));
    }
    return paths;
}

PathFlood floodFromPaths(const InsideVolume& inside, const std::vector<std::vector<Index3>>& paths)
{
    std::vector<std::uint32_t> seeds;
    for (const std::vector<Index3>& path : paths)
        for (const Index3 v : path)
            seeds.push_back(std::uint32_t(inside.grid.offset(v)));
    return floodFrom(inside, std::move(seeds));
}

Labelling floodPieces(const InsideVolume& inside, const Skeleton& skeleton, const std::vector<Path>& paths,
                      double length_mm, std::optional<PathFlood> ahead)
{
    std::vector<std::uint32_t> seeds;
    for (const Path& path : paths)
        for (const PathVoxel& v : path.voxels)
            seeds.push_back(std::uint32_t(v.voxel));
    if (!ahead || ahead->seeds != seeds || ahead->label.size() != inside.voxels.size())
        ahead = floodFrom(inside, std::move(seeds));
    Labelling labelling;
    std::vector<std::uint16_t> label_of{LumenFront::kNoLabel};
    for (const Path& path : paths)
        cutPath(label_of, labelling, skeleton, path, length_mm);
    for (const std::uint32_t voxel : ahead->loose) {
        const double station = skeleton.nearest(inside.grid.pointAt(inside.grid.indexOf(voxel))).station_mm;
        label_of.push_back(newLabel(labelling, {station, station, -1}));
    }
    labelling.label = std::move(ahead->label);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, labelling.label.size(), 1 << 16), [&](const auto& range) {
        for (std::size_t n = range.begin(); n < range.end(); ++n)
            labelling.label[n] = label_of[labelling.label[n]];
    });
    return labelling;
}

}  // namespace vicon::steps
