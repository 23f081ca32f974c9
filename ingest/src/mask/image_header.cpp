#include "mask/image_header.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mask/refusal.h"

namespace vicon::ingest {
namespace {

// As for slices, see docs/admin/import-rules.md.
constexpr double kLeastStep_mm = 0.01, kLargestStep_mm = 20, kFarthest_mm = 10000;
constexpr std::int64_t kLongestAxis = 65535;
/// Of the cosine between two axes: headers keep single precision.
constexpr double kOrthogonal = 1e-3;

bool isUsable(const Placement& placement)
{
    const auto isNear = [](double mm) { return std::abs(mm) <= kFarthest_mm; };  // false for what is no number
    const Point3 p = placement.first_mm;
    return isNear(p.x) && isNear(p.y) && isNear(p.z) &&
           std::all_of(placement.step_mm.begin(), placement.step_mm.end(), [](Vector3 step) {
               const double mm = length(step);
               return mm >= kLeastStep_mm && mm <= kLargestStep_mm;
           });
}

double cosineOf(Vector3 a, Vector3 b)
{
    return std::abs(dot(normalized(a), normalized(b)));
}

}  // namespace

std::size_t bytesOf(VoxelType type)
{
    switch (type) {
        case VoxelType::u8:
        case VoxelType::i8:
            return 1;
        case VoxelType::u16:
        case VoxelType::i16:
            return 2;
        case VoxelType::u32:
        case VoxelType::i32:
        case VoxelType::f32:
            return 4;
        default:
            return 8;
    }
}

Grid latticeOf(const Placement& placement, double largest_mvoxel, const std::filesystem::path& file)
{
    double voxels = 1;
    for (const std::int64_t size : placement.size) {
        if (size < 1 || size > kLongestAxis)
            throw maskRefused(file, "its header says " + std::to_string(size) + " voxels along an axis",
                              "write a mask of three dimensions");
        voxels *= double(size);
    }
    if (voxels > largest_mvoxel * 1e6)
        throw maskRefused(file, "its header says more voxels than import.largest_volume_mvoxel",
                          "write the mask on the scan's own lattice");
    if (!isUsable(placement))
        throw maskRefused(file, "its header gives a place or a voxel's size that cannot be",
                          "write the mask with its place in mm");
    const auto& [x, y, z] = placement.step_mm;
    if (std::max({cosineOf(x, y), cosineOf(x, z), cosineOf(y, z)}) > kOrthogonal)
        throw maskRefused(file, "its axes are not orthogonal", "resample the mask onto the scan's lattice first");
    Grid grid;
    grid.origin_mm = placement.first_mm;
    grid.axis[0] = normalized(x);
    grid.axis[1] = normalized(y - grid.axis[0] * dot(y, grid.axis[0]));
    const Vector3 across = cross(grid.axis[0], grid.axis[1]);
    grid.axis[2] = dot(across, z) < 0 ? -across : across;
    for (std::size_t a = 0; a < 3; ++a) {
        grid.size[a] = int(placement.size[a]);
        grid.spacing_mm[a] = length(placement.step_mm[a]);
    }
    return grid;
}

}  // namespace vicon::ingest
