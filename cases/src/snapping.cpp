#include <algorithm>
#include <array>
#include <cmath>

#include "vicon/cases/placing.h"
#include "vicon/core/error.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/scan_files/subdivision_file.h"
#include "vicon/scan_files/volume_file.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

/// Segments end where flooded fronts met, not across the curve, so a point's foot may lie in the neighbour. Less than
/// half of the least distance along the curve between two loops that touch. Seen on seed 1 of the default phantom, in a
/// bend.
constexpr double kSegmentMargin_mm = 20;

struct NearestVoxel {
    int segment = 0;
    double distance_mm = 1e300;
};

/// The inside voxel nearest to `p` within a ball, by its centre; a point within half a voxel of it counts as inside.
NearestVoxel nearestInside(const SegmentVolume& segments, Point3 p, double within_mm)
{
    const Grid& grid = segments.grid;
    const Index3 centre = grid.indexAt(p);
    NearestVoxel nearest;
    std::array<int, 3> reach{};
    for (std::size_t a = 0; a < 3; ++a)
        reach[a] = int(std::ceil(within_mm / grid.spacing_mm[a])) + 1;
    for (int k = std::max(0, centre.k - reach[2]); k <= std::min(grid.size[2] - 1, centre.k + reach[2]); ++k)
        for (int j = std::max(0, centre.j - reach[1]); j <= std::min(grid.size[1] - 1, centre.j + reach[1]); ++j)
            for (int i = std::max(0, centre.i - reach[0]); i <= std::min(grid.size[0] - 1, centre.i + reach[0]); ++i)
                if (const int segment = segments.at({i, j, k})) {
                    const double d = distance(grid.pointAt(Index3{i, j, k}), p);
                    if (d < nearest.distance_mm)
                        nearest = {segment, d};
                }
    if (segments.valueOr(centre, 0))
        nearest.distance_mm = 0;
    return nearest;
}

/// The skeleton; of a tree the way from the root that passes nearest to the point.
Skeleton wayThrough(const fs::path& file, Point3 point)
{
    const SkeletonTree tree = scan_files::readSkeletonTree(file);
    if (tree.empty())
        return scan_files::readSkeleton(file);
    Skeleton best;
    double least_mm = 1e300;
    for (const int tip : tree.tips()) {
        Skeleton way = tree.pathTo(tip);
        if (const double away_mm = way.nearest(point).distance_mm; away_mm < least_mm) {
            least_mm = away_mm;
            best = std::move(way);
        }
    }
    return best;
}

}  // namespace

bool isPrepared(const fs::path& folder)
{
    return fs::exists(folder / "skeleton.vtp") && fs::exists(folder / "segments.mha") &&
           fs::exists(folder / "subdivision.json");
}

std::optional<SnappedPoint> snapToSkeleton(const fs::path& folder, Point3 point, double within_mm)
{
    if (!isPrepared(folder))
        throw Error(ErrorCode::not_ready, "the scan has not been through the pipeline", folder.filename().string(),
                    "run 'vicon work --until-idle'");
    const auto segments = scan_files::readVolume<std::uint16_t>(folder / "segments.mha");
    const NearestVoxel voxel = nearestInside(segments, point, within_mm);
    if (voxel.segment == 0 || voxel.distance_mm > within_mm)
        return std::nullopt;
    const Skeleton skeleton = wayThrough(folder / "skeleton.vtp", point);
    const auto subdivision = scan_files::readSubdivision(folder / "subdivision.json");
    const auto& info = subdivision.segments.at(std::size_t(voxel.segment) - 1);
    const SkeletonFoot foot =
        skeleton.nearest(point, info.from_station_mm - kSegmentMargin_mm, info.to_station_mm + kSegmentMargin_mm);
    return SnappedPoint{voxel.distance_mm, foot.station_mm, skeleton.length_mm()};
}

}  // namespace vicon
