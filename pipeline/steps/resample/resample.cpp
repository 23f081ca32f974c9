#include "vicon/steps/resample.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "grid/allocate.h"
#include "resample/oriented_scan.h"
#include "resample/sampling.h"
#include "resample/slab.h"

namespace vicon::steps {
namespace {

// So many voxels at a time: enough slabs for all threads to end together, and each worth a filter of its own.
constexpr int kSlab_voxels = 1 << 20;
// Smooth interpolation needs slices around each slab as well: thicker slabs waste less.
constexpr int kSmoothSlab_slices = 24;

void requireVoxels(const HuVolume& acquired)
{
    const Grid& grid = acquired.grid;
    for (std::size_t d = 0; d < 3; ++d)
        if (grid.size[d] < 1 || !(grid.spacing_mm[d] > 0) || !std::isfinite(grid.spacing_mm[d]))
            throw Error(ErrorCode::bad_input, "the volume has no voxels or no spacing");
    if (acquired.voxels.size() != grid.voxelCount())
        throw Error(ErrorCode::bad_input, "the volume's voxels do not fit its grid");
}

}  // namespace

HuVolume resample(HuVolume acquired, const ResampleOptions& options, Progress& progress)
{
    requireVoxels(acquired);
    progress.report(0, "resampling");
    const OrientedScan scan = orient(acquired);
    const auto& spacings_mm = scan.grid.spacing_mm;
    const Sampling sampling = sampleIsotropically(
        scan.grid,
        options.spacing_mm > 0 ? options.spacing_mm : *std::min_element(spacings_mm.begin(), spacings_mm.end()));
    const Grid& grid = sampling.grid;
    if (scan.asStored() && grid.size == scan.grid.size && grid.spacing_mm == spacings_mm) {
        acquired.grid = grid;
        return acquired;
    }
    auto out = makeVolume<std::int16_t>(grid);
    const int slice_voxels = std::max(1, grid.size[0] * grid.size[1]);
    const int thickness = std::max(1, kSlab_voxels / slice_voxels), slices = grid.size[2];
    tbb::parallel_for(0, (slices + thickness - 1) / thickness, [&](int slab) {
        progress.check();
        const SliceRange range{slab * thickness, std::min(slices, (slab + 1) * thickness)};
        resampleLinearly(scan, sampling, range, &out.at({0, 0, range.begin}));
    });
    if (options.interpolation != Interpolation::linear && sampling.movesAny())
        for (SliceRange range; range.begin < slices; range.begin = range.end) {
            range.end = std::min(slices, range.begin + kSmoothSlab_slices);
            progress.report(double(range.begin) / slices, "resampling");
            progress.check();
            smoothOver(scan, sampling, range, options.interpolation, &out.at({0, 0, range.begin}));
        }
    progress.check();
    progress.report(1, "resampling");
    return out;
}

}  // namespace vicon::steps
