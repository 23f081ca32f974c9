#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/core/skeleton.h"
#include "vicon/core/volume.h"
#include "vicon/steps/lumen_plan.h"

namespace vicon::steps {

struct SkeletonOptions {
    double step_mm = 1;
    double path_smoothing_mm = 4;
    double smoothing_mm = 3.5;
    int recentrings = 14;
    int rays = 32;
    double uncovered_mm = 40;
    double uncovered_fraction = 0.005;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("skeleton.step_mm", step_mm, "mm", "Distance between points of the centreline.", {0.25, 5});
        v("skeleton.path_smoothing_mm", path_smoothing_mm, "mm",
          "Standard deviation of the Gaussian along the voxel path.", {0, 20});
        v("skeleton.smoothing_mm", smoothing_mm, "mm", "Standard deviation of the Gaussian after each recentring.",
          {0, 20});
        v("skeleton.recentrings", recentrings, "",
          "How often the centreline is moved to the middle of its cross-sections.", {0, 30});
        v("skeleton.rays", rays, "", "Rays per cross-section.", {8, 512});
        v("skeleton.uncovered_mm", uncovered_mm, "mm",
          "Lumen farther than this from the path, measured inside the lumen, is not covered by it.", {10, 200});
        v("skeleton.uncovered_fraction", uncovered_fraction, "",
          "Share of the lumen that may stay uncovered before the path is taken to cut through a contact.", {0, 1});
    }
};

struct SkeletonResult {
    Skeleton curve;         ///< pieces and bridges from rectum to caecum
    SkeletonVoxels voxels;  ///< the 26-connected path of each piece
    nlohmann::json measures = nlohmann::json::object();
};

/// What a caller may begin while the skeleton is being found; called on any thread.
struct SkeletonHooks {
    std::function<void()> core_free;  ///< one core has nothing to do from here until the path is found
    /// With the voxel path of each piece, as soon as all have one; once more, where what these leave aside led to
    /// others.
    std::function<void(const std::vector<std::vector<Index3>>&)> paths_found;
};

/// Finds the centred curve of the lumen from rectum to caecum. Empty for a plan without pieces.
/// Method: Dijkstra's shortest path with a cost of length x (5 mm / wall distance)^4, which is drawn to the middle and
/// away from contacts between loops; the smooth curve is the path's, moved again and again to the middle of its
/// cross-sections and held within the largest balls about the path. Throws Error{bad_input} when an end of a piece does
/// not lie in the lumen, and Error{cancelled}.
SkeletonResult findSkeleton(const InsideVolume& inside, const LumenPlan& plan, const SkeletonOptions& options,
                            Progress& progress, const SkeletonHooks& hooks = {});

}  // namespace vicon::steps
