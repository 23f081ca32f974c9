#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vicon/core/skeleton.h"
#include "vicon/core/volume.h"
#include "vicon/scan_files/cells_file.h"
#include "vicon/scan_files/subdivision_file.h"

namespace vicon::viewer::test {

/// How a scan's voxels are stored: the body is the same in all of them.
struct Storage {
    std::string name;
    std::array<Vector3, 3> axis;
};
/// As scanners store supine and prone, head first and feet first; a mirrored and an oblique grid.
std::vector<Storage> storages();

/// A small colon of closed form: a tube with folds from the rectum (low, middle) up the patient's left side, across
/// before the belly and down the right side to the caecum, with one polyp on the wall. Everything a scan's folder
/// holds, at `voxel_mm`.
struct TestColon {
    HuVolume volume;
    InsideVolume inside;
    FieldVolume wall_distance, exit_distance;
    SegmentVolume segments;
    Skeleton skeleton;
    CellSurface cells;
    Subdivision subdivision;
    Point3 polyp_mm;  ///< the sphere's middle, on the wall
    double polyp_radius_mm = 0;
    double polyp_station_mm = 0;

    explicit TestColon(const Storage& storage = storages().front(), double voxel_mm = 2);
    /// Writes it as a scan's folder.
    void write(const std::filesystem::path& folder) const;
};

/// Exact distance to the wall by parabolas, less half a voxel: 0 outside, at least a quarter of a voxel inside.
FieldVolume wallDistanceOf(const InsideVolume& inside);

/// Gates of segments that touch: a box around all faces that two segments share, dilated by a voxel's diagonal.
std::vector<Portal> portalsOf(const SegmentVolume& segments);

}  // namespace vicon::viewer::test
