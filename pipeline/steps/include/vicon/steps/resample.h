#pragma once

#include <string>

#include "vicon/core/option_names.h"
#include "vicon/core/options.h"
#include "vicon/core/progress.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// What lies between acquired voxels.
enum class Interpolation { linear, bspline, windowed_sinc };
inline constexpr EnumNames<Interpolation, 3> kInterpolationNames{{
    {Interpolation::linear, "linear"},
    {Interpolation::bspline, "bspline"},
    {Interpolation::windowed_sinc, "windowed_sinc"},
}};
constexpr const auto& optionNames(Interpolation /*value*/)
{
    return kInterpolationNames;
}

struct ResampleOptions {
    double spacing_mm = 0;
    Interpolation interpolation = Interpolation::linear;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("resample.spacing_mm", spacing_mm, "mm",
          "Edge of the isotropic voxels; 0 takes the smaller of in-plane and slice spacing.", OptionLimits{0, 5});
        v("resample.interpolation", interpolation, "",
          "linear; bspline (cubic) and windowed_sinc (Lanczos) keep edges sharper, overshoot beside them and take "
          "minutes.",
          choicesOf(interpolation));
    }
};

/// The isotropic volume of a scan, by ITK's interpolation.
///
/// The result is canonical: its axes are those of `acquired`, permuted and flipped so that they lie nearest to +x, +y
/// and +z (LPS); what rotation remains is kept in `grid.axis`. Its first voxel is the acquired voxel of least x, y, z,
/// and no voxel lies beyond the last acquired one. The voxels are bit for bit the same whatever order or mirroring the
/// acquired voxels are stored in, and do not depend on the number of threads; the origin is rounded to 1e-6 mm.
/// Padding (kPaddingHu) stays out of the interpolation: where a neighbour is padding, the nearest voxel's value is
/// taken. Smooth interpolation gives way to the linear one wherever padding would have a weight in it.
///
/// @param acquired is freed before the function returns, so the peak is input plus output; beyond that only slabs are
/// held Throws Error{bad_input} for a volume without voxels or without a positive spacing, Error{no_memory} when the
/// result does not fit into this machine's memory.
HuVolume resample(HuVolume acquired, const ResampleOptions& options, Progress& progress);

}  // namespace vicon::steps
