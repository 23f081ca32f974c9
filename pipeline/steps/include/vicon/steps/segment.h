#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/core/geometry_json.h"
#include "vicon/core/option_names.h"
#include "vicon/core/options.h"
#include "vicon/core/progress.h"
#include "vicon/core/verdict.h"
#include "vicon/core/volume.h"
#include "vicon/steps/lumen_plan.h"
#include "vicon/steps/wall_densities.h"

namespace vicon::steps {

/// How the lumen is sought.
enum class SegmentMethod { automatic, binary };
inline constexpr EnumNames<SegmentMethod, 2> kSegmentMethodNames{{
    {SegmentMethod::automatic, "auto"},
    {SegmentMethod::binary, "binary"},
}};
constexpr const auto& optionNames(SegmentMethod /*value*/)
{
    return kSegmentMethodNames;
}

struct SegmentOptions {
    SegmentMethod method = SegmentMethod::automatic;
    double gas_below_hu = -800;
    WallDensities densities;
    double fluid_above_hu = 200;
    double smallest_piece_ml = 2;
    double leak_mm = 3;
    double catheter_radius_mm = 3;
    double longest_sure_bridge_mm = 60;
    double shortest_mm = 250;
    double usual_mm = 900;
    double longest_mm = 3000;
    double least_ml = 20;
    std::vector<Point3> add;
    std::vector<Point3> cut;
    std::vector<Point3> drop;
    double iso_hu = -800;
    std::vector<Point3> seed;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("segment.method", method, "",
          "auto: gas and tagged fluid of the whole colon; binary: what lies below iso_hu around the seed point.",
          choicesOf(method));
        v("segment.gas_below_hu", gas_below_hu, "HU", "Voxels below this density are the core of gas.", {-1000, -500});
        densities.visit(v);
        v("segment.fluid_above_hu", fluid_above_hu, "HU", "Tagged fluid has at least this density.", {100, 1000});
        v("segment.smallest_piece_ml", smallest_piece_ml, "ml",
          "Smaller pieces of gas are not taken as pieces of the colon.", {0.1, 50});
        // On the prone scan of the reference data 1.5 mm leaves small bowel attached.
        v("segment.leak_mm", leak_mm, "mm",
          "Passages between pools of fluid of a smaller radius than this are holes in a thin wall, not bowel.",
          {0.5, 10});
        v("segment.catheter_radius_mm", catheter_radius_mm, "mm",
          "What is narrower than this below the rectum is catheter, not lumen.", {0, 8});
        v("segment.longest_sure_bridge_mm", longest_sure_bridge_mm, "mm",
          "A longer bridge over a collapsed part is reported as uncertain.", {1, 500});
        v("segment.shortest_mm", shortest_mm, "mm", "A shorter run of gas and fluid is no colon.", {0, 1000});
        v("segment.usual_mm", usual_mm, "mm", "A shorter colon is doubted; lower it after a resection.", {0, 2000});
        v("segment.longest_mm", longest_mm, "mm", "A longer colon is doubted.", {1000, 6000});
        v("segment.least_ml", least_ml, "ml", "Less gas and fluid is no colon.", {0, 500});
        v("segment.add", add, "mm", "Points (LPS) whose gas or fluid belongs to the colon.");
        v("segment.cut", cut, "mm", "Points (LPS) where the lumen is cut; the smaller part is dropped.");
        v("segment.drop", drop, "mm", "Points (LPS) whose piece does not belong to the colon.");
        v("segment.iso_hu", iso_hu, "HU", "Iso value of the binary method.", {-1000, 3000});
        v("segment.seed", seed, "mm",
          "Point (LPS) at which method binary alone begins, the first of several; none: the largest piece inside the "
          "body. It corrects nothing: see segment.add.");
    }
};

/// What segmentColon() found.
struct Segmentation {
    InsideVolume inside;  ///< labels kGas and kFluid; cropped, with outside voxels around except where the scan ends
    LumenPlan plan;
    Verdict verdict = Verdict::unsure;
    double confidence = 0;  ///< 0 to 1: how sure the verdict and the plan are
    std::string reason;     ///< why, for a person
    nlohmann::json measures = nlohmann::json::object();
};

/// Finds the lumen of the colon, gas and tagged fluid, from rectum to caecum.
/// A scan without a colon is no error: the verdict says so, and `inside` is empty (size 0).
/// Throws Error{wrong_use} for densities that cannot be, Error{cancelled}.
/// @param volume isotropic densities in HU; axes near +x left, +y posterior, +z head; padding kPaddingHu
/// @param gravity unit vector along which fluid falls, see vicon::gravityFor()
Segmentation segmentColon(const HuVolume& volume, Vector3 gravity, const SegmentOptions& options, Progress& progress);

/// The same for a lumen that a person gave. Where half of a voxel of the scan lies in it, the voxel is gas or fluid by
/// its density; what is as dense as tissue is left out (measure given_dense_ml), but for the blurred edge. Its pieces
/// are put in order as those that are found; none is cut, trimmed or left out but those below
/// `options.smallest_piece_ml`. Corrections act on it as on what is found.
/// @param given 1 in the lumen, else 0; on any lattice in LPS mm, also a left-handed one
Segmentation segmentGivenColon(const HuVolume& volume, const InsideVolume& given, Vector3 gravity,
                               const SegmentOptions& options, Progress& progress);

}  // namespace vicon::steps
