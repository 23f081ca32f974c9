#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "vicon/core/volume_view.h"

namespace vicon::viewer {

/// Densities of the tissue within a ball: the virtual biopsy of a finding.
struct Biopsy {
    static constexpr int kBin_hu = 25;
    static constexpr std::size_t kLeastVoxels = 20;  ///< of fewer, noise of 25 HU leaves the mean out by 6 HU and more

    Point3 centre_mm;
    double radius_mm = 0;
    double margin_mm = 0;     ///< nothing nearer than this to gas or fluid was taken
    std::size_t voxels = 0;   ///< 0, or kLeastVoxels and more
    double mean_hu = 0;       ///< 0 where there are no voxels, as are the next two
    double sd_hu = 0;         ///< standard deviation
    double fat_fraction = 0;  ///< of the voxels, those of fat's density, -200 to -30 HU
    int from_hu = 0;          ///< lower bound of the histogram's first bin, a multiple of kBin_hu
    std::vector<std::size_t> counts;
};

/// Takes the voxels whose middles lie within `radius_mm` of `centre`, in tissue alone. A voxel beside the lumen has a
/// density between that of the tissue and that of the gas or tagged fluid, so a margin of 2 mm and at least 1.5 voxels
/// is kept to the lumen's border; where a small finding has fewer than kLeastVoxels then, one of 1.5 voxels; where it
/// still has, no voxels are given. Padding is left out. `inside` may cover a part of the volume only: there is no lumen
/// beyond it. Throws Error{wrong_use} for a radius outside 0.5 to 25 mm.
Biopsy takeBiopsy(const HuView& volume, const InsideView& inside, Point3 centre, double radius_mm);

/// As it is kept with a marker, under "density": {"position_mm", "radius_mm", "margin_mm", "voxels", "mean_hu",
/// "sd_hu", "fat_fraction", "histogram": {"from_hu", "bin_hu", "counts"}}.
nlohmann::json toJson(const Biopsy& biopsy);
/// Nothing taken (voxels 0) where the JSON is not a biopsy's.
Biopsy biopsyFromJson(const nlohmann::json& json);

}  // namespace vicon::viewer
