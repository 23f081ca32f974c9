#pragma once

#include "vicon/core/colon_parts.h"
#include "vicon/core/options.h"
#include "vicon/core/progress.h"
#include "vicon/core/scan_quality.h"
#include "vicon/core/skeleton.h"
#include "vicon/core/untrusted_wall.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

struct QualityOptions {
    double collapsed_radius_mm = 3;
    double longest_collapsed_mm = 10;
    double usual_noise_hu = 40;
    double shortest_mm = 1100;
    double longest_mm = 2700;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("quality.collapsed_radius_mm", collapsed_radius_mm, "mm",
          "Where a disc as large as the cross-section is smaller, the colon counts as collapsed.", {0.5, 10});
        v("quality.longest_collapsed_mm", longest_collapsed_mm, "mm",
          "A longer collapsed stretch could hide a lesion of 10 mm: the part is not adequate (C-RADS C0).", {1, 100});
        v("quality.usual_noise_hu", usual_noise_hu, "HU", "More noise than this is pointed out.", {5, 200});
        v("quality.shortest_mm", shortest_mm, "mm",
          "A shorter centreline is not plausible for a whole colon; lower it after a resection.", {0, 3000});
        v("quality.longest_mm", longest_mm, "mm", "A longer centreline is not plausible.", {1000, 5000});
    }
};

/// Measures how well a scan shows the colon.
///
/// Cross-sections come from the lumen's volume: each voxel belongs to the station whose front of a flood from the whole
/// skeleton reaches it first (on blocks of 2 x 2 x 2 voxels), averaged over 10 mm (a triangle of 20 mm).
/// @param noise_hu of softTissueNoise()
/// @param untrusted of findTissue(): told are half a millilitre or more of mottled tagging in a part, and faint walls
/// Throws Error{bad_input} when the skeleton is empty, Error{cancelled}.
ScanQuality measureQuality(const InsideVolume& inside, const Skeleton& skeleton, const ColonPartRanges& parts,
                           double noise_hu, const UntrustedWall& untrusted, const QualityOptions& options,
                           Progress& progress);

}  // namespace vicon::steps
