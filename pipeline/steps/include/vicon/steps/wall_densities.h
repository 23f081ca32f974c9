#pragma once

#include "vicon/core/options.h"
#include "vicon/core/usual_densities.h"

namespace vicon::steps {

/// The densities between which the wall lies: of the mask, of the surface and of the distances alike.
struct WallDensities {
    double wall_hu = kUsualWall_hu;
    double tissue_hu = kUsualTissue_hu;

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
