#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vicon/core/volume.h"

namespace vicon::steps {

/// The surface in units of voxels of the labels' grid.
struct Contour {
    std::vector<float> points;             ///< x, y, z
    std::vector<std::uint32_t> triangles;  ///< front side towards lower values of the field: the lumen
    std::size_t on_edges = 0;              ///< so many points, the first ones, lie between two neighbouring voxels

    std::size_t pointCount() const { return points.size() / 3; }
    std::size_t triangleCount() const { return triangles.size() / 3; }
};

/// Where a field is 0: closed, every edge in two triangles. The field has one more voxel on every side than the labels.
Contour contourOf(Volume<std::int16_t>& field);

/// Divides edges of the contour whose middle lies off the surface of the field between its voxels, and puts their
/// middles there. The rim of a fold that is hardly thicker than a voxel would be a saw otherwise: it ends between two
/// voxels here, and at one there. An edge is divided for both of its triangles, so that the surface stays closed.
/// The result does not depend on the number of threads.
void divideAtRims(const Volume<std::int16_t>& field, Contour& contour);

/// Voxels around a point of the contour, and what each counts for it; the first is the nearest one inside, if any is.
struct NearVoxels {
    std::array<Index3, 8> voxels;
    std::array<double, 8> weights{};
    std::size_t count = 0;
};
NearVoxels voxelsNear(const Contour& contour, std::size_t point, const InsideVolume& inside);

}  // namespace vicon::steps
