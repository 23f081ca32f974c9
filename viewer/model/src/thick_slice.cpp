#include "vicon/viewer/model/thick_slice.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "vicon/viewer/model/slice_image.h"

namespace vicon::viewer {
namespace {

/// A plane at `offset_mm` along the direction of view.
std::vector<float> planeAt(const HuView& volume, const HuView* cleansed, PlaneView view, double offset_mm,
                           const Progress* wanted)
{
    view.centre_mm += view.forward() * offset_mm;
    return cleansed ? sliceDensities(volume, *cleansed, view, wanted) : sliceDensities(volume, view, wanted);
}

float together(const std::vector<std::vector<float>>& planes, std::size_t pixel, ThickSlice::Kind kind)
{
    float sum = 0, least = 0;
    int count = 0;
    for (const std::vector<float>& plane : planes) {
        const float density = plane[pixel];
        if (density == float(kPaddingHu))
            continue;
        least = count == 0 ? density : std::min(least, density);
        sum += density;
        ++count;
    }
    if (count == 0)
        return float(kPaddingHu);
    return kind == ThickSlice::Kind::mean ? sum / float(count) : least;
}

}  // namespace

std::string nameOf(const ThickSlice& thick)
{
    if (thick.kind == ThickSlice::Kind::one_plane)
        return {};
    return (thick.kind == ThickSlice::Kind::mean ? "mean of " : "minimum of ") +
           std::to_string(std::lround(thick.thickness_mm)) + " mm";
}

std::vector<float> thickSliceDensities(const HuView& volume, const HuView* cleansed, const PlaneView& view,
                                       const ThickSlice& thick, const Progress* wanted)
{
    if (thick.kind == ThickSlice::Kind::one_plane)
        return planeAt(volume, cleansed, view, 0, wanted);
    const auto& spacing = volume.grid.spacing_mm;
    const double voxel_mm = *std::min_element(spacing.begin(), spacing.end());
    const int gaps = 2 * std::max(1, int(std::ceil(thick.thickness_mm / 2 / voxel_mm)));  // the plane itself is one
    std::vector<std::vector<float>> planes(std::size_t(gaps) + 1);
    tbb::parallel_for(std::size_t(0), planes.size(), [&](std::size_t n) {
        planes[n] = planeAt(volume, cleansed, view, thick.thickness_mm * (double(n) / gaps - 0.5), wanted);
    });
    std::vector<float> densities(planes.front().size());
    for (std::size_t n = 0; n < densities.size(); ++n)
        densities[n] = together(planes, n, thick.kind);
    return densities;
}

}  // namespace vicon::viewer
