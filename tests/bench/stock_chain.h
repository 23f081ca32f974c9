#pragma once

#include <filesystem>

namespace vicon::bench {

/// The chain of stock filters that does what there are stock filters for: GDCM's series reader, ResampleImageFilter to
/// the isotropic grid, BinaryThreshold, ConnectedComponent, RelabelComponent, SignedMaurerDistanceMap, FastMarching and
/// vtkMarchingCubes. No skeleton, no segments, nothing written. Intermediate images are freed as soon as they are used.
/// Prints a line "STEP SECONDS" per step on the standard output.
/// @param series a folder that holds one series
void runStockChain(const std::filesystem::path& series);

}  // namespace vicon::bench
