#pragma once

#include <cstddef>
#include <vector>

#include "tissue/mixture.h"

namespace vicon::steps {

inline constexpr double kLargestStool_mm3 = 15000;  ///< a ball of 3 cm; more is bowel or bone

/// Lumps of tagged stool on the wall, which no fluid level shows.
struct Stool {
    std::size_t lumps = 0;
    std::vector<std::size_t> dense;  ///< voxels of the labels' grid, ascending: tagged
    std::vector<std::size_t> mixed;  ///< ascending: of the lumen, gas and stool in one voxel
    std::vector<std::size_t> wall;   ///< ascending: bright, but all that parts the lumen's sides there
    std::vector<std::size_t> left;   ///< ascending: dense, but not told from a thin fold under it
};

/// Finds what is as bright as tagging, lies outside the labels and meets gas without a wall between them over a good
/// part of its surface. Bone and other bowel lie behind a wall, and only meet gas where that is too thin to be seen.
/// @param bright_hu tagging has at least this density
/// @param blur_mm standard deviation of the point spread
Stool findStool(const Mixture& mixture, double bright_hu, double blur_mm);

/// Gives stool its labels: what is dense is fluid, what is mixed gas or fluid by its density.
/// @param labels on the mixture's grid
void labelStool(const Mixture& mixture, const Stool& stool, InsideVolume& labels);

}  // namespace vicon::steps
