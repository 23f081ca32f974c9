#pragma once

namespace vicon {

/// Densities in HU as CT gives them, where nothing else is said of a scan: defaults of the options, and of what shows
/// what the steps have found.
/// @{
/// Gas.
inline constexpr double kUsualAir_hu = -1000;
/// The colon's wall, and soft tissue around it (segment.tissue_hu).
inline constexpr double kUsualTissue_hu = 40;
/// From what fills the lumen to tissue: on the scale of CT, on which MR's noise is kept as a share of it.
inline constexpr double kUsualLumenToTissue_hu = kUsualTissue_hu - kUsualAir_hu;
/// Half-way between the two, where mask and surface end (segment.wall_hu).
inline constexpr double kUsualWall_hu = -480;
/// Tagged fluid is at least so much brighter than the wall (tissue.tag_contrast_hu).
inline constexpr double kUsualTagContrast_hu = 120;
/// @}

}  // namespace vicon
