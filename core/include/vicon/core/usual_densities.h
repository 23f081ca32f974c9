#pragma once

namespace vicon {

/// Densities in HU as CT gives them, where nothing else is said of a scan: defaults of the options, and of what shows
/// what the steps have found.
/// @{
/// Gas.
inline constexpr double kUsualAir_hu = -1000;
/// The colon's wall, and soft tissue around it (segment.tissue_hu).
inline constexpr double kUsualTissue_hu = 40;
/// Half-way between the two, where mask and surface end (segment.wall_hu).
inline constexpr double kUsualWall_hu = -480;
/// Tagged fluid is at least so much brighter than the wall (tissue.tag_contrast_hu).
inline constexpr double kUsualTagContrast_hu = 120;
/// @}

}  // namespace vicon
