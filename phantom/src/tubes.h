#pragma once

#include <vector>

#include "random.h"
#include "vicon/core/skeleton_tree.h"
#include "vicon/core/volume.h"

namespace vicon::phantom {

/// Signed distance to the tubes of a tree, negative inside; every stretch is a cone between two balls.
double tubesDistance(const SkeletonTree& tree, Point3 p, double limit_mm);

/// Distance of every voxel to the tubes, up to `limit_mm`, which also stands for what is farther.
FieldVolume tubesField(const Grid& grid, const SkeletonTree& tree, double limit_mm);

/// Adds a branch with points at these places and radii; returns its number. Its first point is the parent's last.
int addBranch(SkeletonTree& tree, int parent, const std::vector<Point3>& points, const std::vector<double>& radii_mm);

/// Sorts the branches as SkeletonTree wants them.
SkeletonTree inOrder(const SkeletonTree& tree);

/// A trachea that forks into bronchi, five generations of them; the right main bronchus is shorter and steeper.
SkeletonTree drawAirway(std::uint64_t seed);
/// An aorta from its root over the arch to the iliac arteries, with the three arteries of the arch.
SkeletonTree drawAorta(std::uint64_t seed);

/// The densities around them, in HU, without blur and noise. Bone keeps away from the aorta, by as little as its wall.
double chestHu(Point3 p);
double trunkHu(Point3 p, double aorta_mm);

}  // namespace vicon::phantom
