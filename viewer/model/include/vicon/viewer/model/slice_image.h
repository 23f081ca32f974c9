#pragma once

#include <vector>

#include "vicon/core/progress.h"
#include "vicon/core/volume_view.h"
#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/model/orientation.h"

namespace vicon::viewer {

/// Densities in the plane of a picture, row by row from the top, trilinear between voxels; kPaddingHu outside the
/// scan. The plane may lie in any direction, and so may the scan's axes. Throws
/// Error{cancelled} where `wanted` is no longer.
std::vector<float> sliceDensities(const HuView& volume, const PlaneView& view, const Progress* wanted = nullptr);

/// The same with those of another volume wherever it has any: the densities without tagging, which lie around the
/// lumen.
std::vector<float> sliceDensities(const HuView& volume, const HuView& cleansed, const PlaneView& view,
                                  const Progress* wanted = nullptr);

/// The orthogonal slice through `point` that shows the whole scan, or, with `field_mm` above 0, that much of it around
/// the point.
PlaneView sliceThrough(const Grid& grid, SlicePlane plane, Point3 point, int width, int height, double field_mm = 0);
/// The same of a slice whose picture has these directions.
PlaneView sliceThrough(const Grid& grid, const SliceAxes& axes, Point3 point, int width, int height,
                       double field_mm = 0);

/// The same slice pixel for pixel: the voxel at `point` in the middle, and as many millimetres a pixel as the grid's
/// finest axis in the plane has. Where the grid's axes are those of the picture, nothing is interpolated along it.
/// @param voxels_a_pixel 2: at half resolution, where each pixel is the mean of its two by two voxels
PlaneView pixelForPixel(const Grid& grid, const PlaneView& view, Point3 point, int voxels_a_pixel = 1);

/// The smallest box around a grid, in patient coordinates.
struct Bounds {
    Point3 lower_mm, upper_mm;
    Point3 centre_mm() const { return interpolate(lower_mm, upper_mm, 0.5); }
};
Bounds boundsOf(const Grid& grid);

}  // namespace vicon::viewer
