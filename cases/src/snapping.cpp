#include "snapping.h"

#include <algorithm>

#include "vicon/cases/placing.h"
#include "vicon/core/error.h"
#include "vicon/core/nearest_voxel.h"
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

/// The segment at a point, and how far away the centre of its nearest voxel is; 0 where the point lies in the voxel.
struct NearestSegment {
    int number = 0;
    double distance_mm = 0;
};

std::optional<NearestSegment> segmentNear(const SegmentVolume& segments, Point3 p, double within_mm)
{
    if (const int own = segments.valueOr(segments.grid.indexAt(p), 0))
        return NearestSegment{own, 0};
    const auto nearest = nearestVoxel(segments.grid, p, within_mm, [&](Index3 v) { return segments.at(v) != 0; });
    if (!nearest)
        return std::nullopt;
    return NearestSegment{segments.at(nearest->voxel), nearest->distance_mm};
}

}  // namespace

bool isPrepared(const fs::path& folder)
{
    return fs::exists(folder / "skeleton.vtp") && fs::exists(folder / "segments.mha") &&
           fs::exists(folder / "subdivision.json");
}

ScanPlaces::ScanPlaces(const fs::path& folder)
{
    if (!isPrepared(folder))
        throw Error(ErrorCode::not_ready, "the scan has not been through the pipeline", folder.filename().string(),
                    "run 'vicon work --until-idle'");
    segments_ = scan_files::readVolume<std::uint16_t>(folder / "segments.mha");
    subdivision_ = scan_files::readSubdivision(folder / "subdivision.json");
    const SkeletonTree tree = scan_files::readSkeletonTree(folder / "skeleton.vtp");
    if (tree.empty())
        ways_.push_back(scan_files::readSkeleton(folder / "skeleton.vtp"));
    for (const int tip : tree.tips())
        ways_.push_back(tree.pathTo(tip));
}

const Skeleton& ScanPlaces::wayNear(Point3 point) const
{
    return *std::min_element(ways_.begin(), ways_.end(), [&](const Skeleton& a, const Skeleton& b) {
        return a.nearest(point).distance_mm < b.nearest(point).distance_mm;
    });
}

std::optional<SnappedPoint> ScanPlaces::at(Point3 point, double within_mm) const
{
    const auto segment = segmentNear(segments_, point, within_mm);
    if (!segment)
        return std::nullopt;
    const Skeleton& way = ways_.size() == 1 ? ways_.front() : wayNear(point);
    const auto& info = subdivision_.segments.at(std::size_t(segment->number) - 1);
    const SkeletonFoot foot =
        way.nearest(point, info.from_station_mm - kSegmentMargin_mm, info.to_station_mm + kSegmentMargin_mm);
    return SnappedPoint{segment->distance_mm, foot.station_mm, way.length_mm()};
}

}  // namespace vicon
