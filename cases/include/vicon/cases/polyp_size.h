#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "vicon/cases/marker_measures.h"
#include "vicon/core/cell_surface.h"
#include "vicon/core/progress.h"
#include "vicon/core/scanner_blur.h"
#include "vicon/core/volume_view.h"

namespace vicon {

/// Either a size, or why there is none.
struct PolypOutline {
    std::optional<PolypSize> size;
    std::optional<PlaneSize> plane;  ///< with a size: in the axial, coronal or sagittal plane that shows it largest
    std::string trouble;             ///< for a reader: "it has no edge all around"; empty with a size
};

/// From the surface to the middle of a polyp of 30 mm.
inline constexpr double kPolypReach_mm = 15;

/// Outlines the polyp under a point of the wall, or around a point in its tissue, as one clicks in a slice: along
/// sections of the surface through its axis, to where each turns concave the most, at the wall or at its stalk. After
/// the rings of curvature of Summers et al., Radiology 2000. On a fold, against another polyp and under fluid there is
/// no outline: its edge is not the polyp's, or not well known. Figures: docs/evaluation/measuring.md. Begins at the
/// surface nearest to the point; where that gives no outline that holds the point, at the surface in other directions
/// from it.
/// @param surface the wall, with normals into the lumen
/// @param lumen the scan's; its axes are those of the planes
/// @param at in the polyp, within kPolypReach_mm of its surface, or 2 mm beside it
/// Throws Error{cancelled} where `wanted`, if there is one, says so.
PolypOutline outlinePolyp(const CellSurface& surface, const InsideView& lumen, Point3 at, const BlurAndNoise& scan,
                          const Progress* wanted = nullptr);

/// As the steps measured them, in scan.json: the blur at fluid levels, the noise in soft tissue; of MR the noise as
/// densities between gas and tissue would have it. Usual ones where they are not known.
BlurAndNoise blurAndNoiseOf(const std::filesystem::path& scan_folder);

/// An outlined polyp's as a marker's size. Only with a size.
MarkerSize sizeOf(const PolypOutline& outline);

}  // namespace vicon
