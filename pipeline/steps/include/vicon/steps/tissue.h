#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "vicon/core/options.h"
#include "vicon/core/progress.h"
#include "vicon/core/scanner_blur.h"
#include "vicon/core/untrusted_wall.h"
#include "vicon/core/usual_densities.h"
#include "vicon/core/volume.h"
#include "vicon/steps/wall_densities.h"

namespace vicon::steps {

/// How much of each voxel is tissue: 0 for none of it, 255 for all.
using TissueVolume = Volume<std::uint8_t>;

struct TissueOptions {
    double usual_blur_mm = kUsualBlur_mm;
    double tag_contrast_hu = kUsualTagContrast_hu;
    bool leave_out_other_bowel = true;  ///< no option: false for a lumen of which a person says that all is colon
    bool find_stool = true;             ///< no option: false where voxels hold no density, which tells tagging

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("tissue.usual_blur_mm", usual_blur_mm, "mm",
          "Standard deviation of the blur where no fluid level shows it; larger for softer kernels.", {0.2, 2});
        v("tissue.tag_contrast_hu", tag_contrast_hu, "HU",
          "Fluid that is less than this much brighter than the wall counts as untagged.", {20, 1000});
    }
};

struct TissueResult {
    TissueVolume tissue;  ///< 255 farther than about 5 mm from the lumen
    InsideVolume lumen;   ///< the labels, with the wall where half of a voxel is tissue
    HuVolume cleansed;    ///< the densities with tagging taken out: -1000 + 1040 x fraction beside tagging
    double blur_mm = 0;   ///< standard deviation of the blur at fluid levels; a usual one where there are none
    UntrustedWall untrusted;
    nlohmann::json found;  ///< other measures, for the step's record
};

/// Finds the fraction of tissue in each voxel of the lumen and about 5 mm around it, as a mixture of tissue with what
/// fills the lumen there.
///
/// Away from fluid levels the densities of an edge tell: between gas and tissue, or tissue and the fluid of that place.
/// At a level the lumen itself passes through tissue's densities. There its density is modelled, a step across gravity
/// blurred by the scanner, whose height, width and fluid are fitted to columns of pure gas over pure fluid; what
/// deviates from it towards tissue is tissue. Sheets of tissue so thin that blur leaves them less than half are scaled
/// by their own height. Along the wall the fraction is smoothed. Where a wall between loops is so faint that a hole is
/// left, that is closed and told. Lumps of tagged stool outside the labels are lumen,
/// but where they lie on thin folds.
///
/// @param hu on the lattice of `inside`, at least as large
/// @param gravity unit vector along which fluid falls
/// @param noise_hu standard deviation of the noise in soft tissue
/// @param cuts_mm where a person cut the labels: what was cut off there stays out, and no wall is told of
/// All volumes lie on the grid of `inside`. The result does not depend on the number of threads.
/// Throws Error{bad_input} when the grids do not fit together, Error{no_memory}.
TissueResult findTissue(const HuVolume& hu, const InsideVolume& inside, Vector3 gravity, const WallDensities& densities,
                        double noise_hu, Progress& progress, const TissueOptions& options = {},
                        const std::vector<Point3>& cuts_mm = {});

}  // namespace vicon::steps
