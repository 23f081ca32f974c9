#pragma once

#include <cmath>

#include "vicon/core/error.h"
#include "vicon/core/options.h"
#include "vicon/core/usual_densities.h"

namespace vicon::steps {

/// The densities between which the wall lies: of the mask, of the surface and of the distances alike.
struct WallDensities {
    double wall_hu = kUsualWall_hu;
    double tissue_hu = kUsualTissue_hu;

    /// Throws Error{wrong_use} where they cannot be those of a lumen that is darker than its wall, or at all.
    void require(bool dark_lumen) const
    {
        constexpr double kApart_hu = 1;  // else nothing tells the one from the other
        if (dark_lumen ? wall_hu > tissue_hu - kApart_hu : std::abs(wall_hu - tissue_hu) < kApart_hu)
            throw Error(ErrorCode::wrong_use,
                        dark_lumen ? "the wall's half-way density must lie below the tissue's"
                                   : "the wall's half-way density and the tissue's are the same",
                        "segment.wall_hu, segment.tissue_hu", "give others");
    }

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("segment.wall_hu", wall_hu, "HU",
          "Half-way density between what fills the lumen and its wall, where mask and surface end.",
          OptionLimits{-1000, 3000});
        v("segment.tissue_hu", tissue_hu, "HU",
          "Density of the wall; under fluid mask and surface end half-way between it and the fluid.",
          OptionLimits{-200, 200});
    }
};

}  // namespace vicon::steps
