#pragma once

#include <string>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/core/volume_view.h"
#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

/// What a slice shows of the planes around its own: the mean reduces noise; the minimum brings out what is dark, such
/// as a gas bubble or fat in a fold.
struct ThickSlice {
    enum class Kind { one_plane, mean, minimum };
    Kind kind = Kind::one_plane;
    double thickness_mm = 5;
    friend bool operator==(const ThickSlice&, const ThickSlice&) = default;
};

/// For captions: "mean of 5 mm"; empty for one plane.
std::string nameOf(const ThickSlice& thick);

/// As sliceDensities(), of planes at most a voxel apart from half the thickness before the view's plane to half of it
/// behind. What lies outside the scan does not count; kPaddingHu where nothing is left.
/// @param cleansed shown where it has densities; nothing: nowhere
std::vector<float> thickSliceDensities(const HuView& volume, const HuView* cleansed, const PlaneView& view,
                                       const ThickSlice& thick, const Progress* wanted = nullptr);

}  // namespace vicon::viewer
