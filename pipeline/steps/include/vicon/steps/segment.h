#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"
#include "vicon/steps/lumen_plan.h"

namespace vicon::steps {

struct SegmentOptions {
    std::string method = "auto";
    double gas_below_hu = -800;
    double wall_hu = -480;
    double tissue_hu = 40;
    double fluid_above_hu = 200;
    double smallest_piece_ml = 2;
    double catheter_radius_mm = 3;
    double longest_sure_bridge_mm = 60;
    std::string add;
    std::string cut;
    std::string drop;
    double iso_hu = -800;
    std::string seed;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("segment.method", method, "",
          "auto: gas and tagged fluid of the whole colon; binary: what lies below iso_hu around the seed point.",
          {.choices = {"auto", "binary"}});
        v("segment.gas_below_hu", gas_below_hu, "HU", "Voxels below this density are the core of gas.", {-1000, -500});
        v("segment.wall_hu", wall_hu, "HU", "Half-way density between gas and the wall, where the lumen ends.",
          {-900, -100});
        v("segment.tissue_hu", tissue_hu, "HU", "Density of the wall, for the half-way density between it and fluid.",
          {-100, 150});
        v("segment.fluid_above_hu", fluid_above_hu, "HU", "Tagged fluid has at least this density.", {100, 1000});
        v("segment.smallest_piece_ml", smallest_piece_ml, "ml",
          "Smaller pieces of gas are not taken as pieces of the colon.", {0.1, 50});
        v("segment.catheter_radius_mm", catheter_radius_mm, "mm",
          "What is narrower than this below the rectum is catheter, not lumen.", {0, 8});
        v("segment.longest_sure_bridge_mm", longest_sure_bridge_mm, "mm",
          "A longer bridge over a collapsed part is reported as uncertain.", {0, 500});
        v("segment.add", add, "", "Points 'x,y,z;x,y,z' in LPS mm whose gas or fluid belongs to the colon.");
        v("segment.cut", cut, "",
          "Points 'x,y,z;x,y,z' in LPS mm where the lumen is cut; the smaller part is dropped.");
        v("segment.drop", drop, "", "Points 'x,y,z;x,y,z' in LPS mm whose piece does not belong to the colon.");
        v("segment.iso_hu", iso_hu, "HU", "Iso value of the binary method.", {-1000, 3000});
        v("segment.seed", seed, "",
          "Seed point 'x,y,z' in LPS mm of the binary method; empty: the largest piece inside the body.");
    }
};

/// What segmentColon() found.
struct Segmentation {
    InsideVolume inside;  ///< labels kGas and kFluid; cropped, with outside voxels around except where the scan ends
    LumenPlan plan;
    std::string verdict;    ///< "colon", "no colon" or "unsure"
    double confidence = 0;  ///< 0 to 1: how sure the verdict and the plan are
    std::string reason;     ///< why, for a person
    nlohmann::json measures = nlohmann::json::object();
};

/// Finds the lumen of the colon, gas and tagged fluid, from rectum to caecum.
/// A scan without a colon is no error: the verdict says so, and `inside` is empty (size 0).
/// Throws Error{cancelled} only, and Error{wrong_use} for a malformed point in the options.
/// @param volume isotropic densities in HU; axes near +x left, +y posterior, +z head; padding kPaddingHu
/// @param gravity unit vector along which fluid falls, see vicon::gravityFor()
Segmentation segmentColon(const HuVolume& volume, Vector3 gravity, const SegmentOptions& options, Progress& progress);

}  // namespace vicon::steps
