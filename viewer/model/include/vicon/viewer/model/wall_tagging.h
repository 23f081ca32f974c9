#pragma once

#include <vector>

#include "vicon/core/progress.h"
#include "vicon/core/scan_records.h"
#include "vicon/core/untrusted_wall.h"
#include "vicon/core/usual_densities.h"
#include "vicon/core/volume_view.h"

namespace vicon::viewer {

/// Between which densities tagging begins.
struct TagDensities {
    double tissue_hu = kUsualTissue_hu;         ///< of the wall
    double contrast_hu = kUsualTagContrast_hu;  ///< how much brighter tagged fluid is at least
};
/// As the steps had them that made the scan's surface; what they do not say keeps its default.
TagDensities tagDensitiesOf(const std::vector<StepRecord>& steps);

/// How much tagging touches each point of a surface, 0 to 1, by the acquired densities before it: under a pool 1, and
/// on what carries a film of contrast, which is a sign of a flat lesion and is not to be taken out unseen. A film
/// thinner than about a millimetre is hidden by the scanner's blur.
/// @param points_mm x, y, z of each point, LPS
/// @param normals unit vectors into the lumen, as many as points
/// @param inside the lumen's labels: what lies behind the next wall does not count
/// @param noise_hu standard deviation of the scan's noise; 0: not known
/// Throws Error{cancelled} where `wanted`, if there is one, says so.
std::vector<float> taggingOf(const std::vector<float>& points_mm, const std::vector<float>& normals,
                             const HuView& volume, const InsideView& inside, double noise_hu,
                             const TagDensities& densities = {}, const Progress* wanted = nullptr);

/// Adds up to 1 to the tagging of points that lie beside stool or mottled tagging, and gives 2 to those that lie in it
/// or on a faint wall.
void addUntrusted(std::vector<float>& tagging, const std::vector<float>& points_mm, const UntrustedWall& untrusted);

}  // namespace vicon::viewer
