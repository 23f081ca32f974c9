#pragma once

#include <string>
#include <vector>

#include "segment/body.h"
#include "segment/pieces/candidates.h"
#include "vicon/core/progress.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// What was found behind a narrow passage near an end of the lumen.
struct IleumCut {
    bool cut = false;       ///< the lumen behind it was taken out
    std::string reason;     ///< for a person; empty where nothing was found
    Point3 end_mm;          ///< the end of the lumen where it was sought
    Point3 valve_mm;        ///< where the passage leaves the colon
    double neck_mm = 0;     ///< its radius
    double removed_ml = 0;  ///< what was taken out
    double shorter_mm = 0;  ///< above 0: nothing was taken out, but the way ends so much earlier, before a narrow tube,
    Point3 moved_end_mm;    ///< here
};

/// Cuts terminal ileum off the candidates: lumen that a bottleneck in the side of the colon leads to, beside which the
/// colon goes on to a wide blind end. A narrow fold or a collapsed part lies across the colon and has nothing wide
/// beside it, so it is no such bottleneck. Where only some of this holds the lumen stays, and the reason says so.
/// Sought at the candidates' tips that lie on the patient's right and low, or in a narrow tube.
/// @param labels gas and fluid of the whole scan; what is cut off becomes kOutside
/// @param keep a person's points whose lumen belongs to the colon: nothing that holds one is cut off
/// @param rim_layers how deep fluid was set aside beside the wall, see markFluidRim()
std::vector<IleumCut> cutIlea(InsideVolume& labels, const std::vector<Candidate>& candidates, int rim_layers,
                              const std::vector<Point3>& keep, const Body& body, Progress& progress);

}  // namespace vicon::steps
