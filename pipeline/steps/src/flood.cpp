#include "flood.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lumen_front.h"
#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

using Labels = LumenFront::Labels;

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

void seedPath(LumenFront& front, Labelling& labelling, const Skeleton& skeleton, const Path& path, double length_mm)
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
        front.seed(v.voxel, 0, std::uint16_t(first + n));
    }
}

}  // namespace

std::vector<Path> pathsOf(const InsideVolume& inside, const Skeleton& skeleton, const artefact::SkeletonVoxels& voxels)
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

Labelling floodPieces(const InsideVolume& inside, const Skeleton& skeleton, const std::vector<Path>& paths,
                      double length_mm)
{
    LumenFront front(inside);
    Labelling labelling;
    for (const Path& path : paths)
        seedPath(front, labelling, skeleton, path, length_mm);
    front.run(Labels::adopt);
    front.runOverCorners(Labels::adopt);
    for (const std::uint32_t voxel : front.unreached()) {
        if (front.time.voxels[voxel] < LumenFront::kUnreached)
            continue;
        const double station = skeleton.nearest(inside.grid.pointAt(inside.grid.indexOf(voxel))).station_mm;
        const std::uint16_t label = newLabel(labelling, {station, station, -1});
        for (const std::uint32_t v : front.componentOf(voxel))
            front.seed(v, 0, label);
    }
    labelling.label = std::move(front.label);
    return labelling;
}

}  // namespace vicon::steps
