#pragma once

#include "vicon/core/geometry_json.h"
#include "vicon/core/option_names.h"
#include "vicon/core/options.h"
#include "vicon/core/organ.h"
#include "vicon/core/progress.h"
#include "vicon/core/skeleton.h"
#include "vicon/core/skeleton_tree.h"
#include "vicon/core/volume.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/skeleton.h"
#include "vicon/steps/wall_densities.h"

namespace vicon::steps {

/// Where the distances of an organ that branches begin; none: a cavity that no path leads through.
enum class TreeRoot { head, far_from_feet, none };
inline constexpr EnumNames<TreeRoot, 3> kTreeRootNames{{
    {TreeRoot::head, "head"},
    {TreeRoot::far_from_feet, "far_from_feet"},
    {TreeRoot::none, "none"},
}};
constexpr const auto& optionNames(TreeRoot /*value*/)
{
    return kTreeRootNames;
}

/// What a hollow organ looks like that is no colon: a tube or a tree of tubes around a tube that runs from head to
/// feet, or a cavity. The presets of config/organs set them; docs/dev/organs.md tells how to add one.
struct OrganOptions {
    std::string name = "colon";
    std::string title = "colon";
    double low_hu = -1100;
    double high_hu = -930;
    WallDensities densities;
    double growth_hu = -1100;
    double explosion = 0;
    double largest_ml = 1000;
    double smallest_ml = 2;
    double neck_mm = 0;
    std::vector<Point3> seed;
    double seed_from_radius_mm = 4;
    double seed_to_radius_mm = 14;
    double seed_length_mm = 20;
    double seed_off_midline = 0.2;
    TreeRoot root = TreeRoot::head;
    double branch_mm = 5;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("organ.name", name, "", "Which organ a scan shows that has none of its own: a preset of config/organs.");
        v("organ.title", title, "", "The organ in words.");
        v("organ.low_hu", low_hu, "HU", "Least density of what fills the organ.", OptionLimits{-1100, 3000});
        v("organ.high_hu", high_hu, "HU", "Largest density of what fills the organ.", OptionLimits{-1100, 3000});
        densities.visit(v);
        v("organ.growth_hu", growth_hu, "HU", "The largest density is raised up to this while nothing leaks.",
          OptionLimits{-1100, 3000});
        v("organ.explosion", explosion, "",
          "Growth of the volume, as a share, in a step of 10 HU that is taken for a leak; 0: no raising.",
          OptionLimits{0, 10});
        v("organ.largest_ml", largest_ml, "ml", "A larger volume is a leak.", OptionLimits{1, 10000});
        v("organ.smallest_ml", smallest_ml, "ml", "A smaller volume is not the organ.", OptionLimits{0, 1000});
        v("organ.neck_mm", neck_mm, "mm", "Passages of a smaller radius than this are leaks; 0: none are.",
          OptionLimits{0, 20});
        v("organ.seed", seed, "mm", "Points (LPS) inside the organ; none: it is sought.");
        v("organ.seed_from_radius_mm", seed_from_radius_mm, "mm", "Least radius of the tube or cavity that is sought.",
          OptionLimits{0.5, 100});
        v("organ.seed_to_radius_mm", seed_to_radius_mm, "mm", "Largest radius of the tube or cavity that is sought.",
          OptionLimits{0.5, 100});
        v("organ.seed_length_mm", seed_length_mm, "mm", "Least length of the tube that is sought, along the body.",
          OptionLimits{1, 1000});
        v("organ.seed_off_midline", seed_off_midline, "",
          "How far from the body's middle it may lie, as a share of the body's width.", OptionLimits{0, 1});
        v("organ.root", root, "",
          "Where distances begin: at the tube's head end, or at what lies farthest, inside, from the feet; none: no "
          "path.",
          choicesOf(root));
        v("organ.branch_mm", branch_mm, "mm",
          "Branches that reach less far beyond their parent's wall are no branches.", OptionLimits{0, 100});
    }
    bool isColon() const { return Organ(name).isColon(); }
    /// False: a cavity, which is flown freely.
    bool hasPath() const { return isColon() || root != TreeRoot::none; }
};

/// Finds the lumen of an organ that is no colon, labelled kGas. The plan has one piece: from the root, as its rectal
/// end, to the point that is farthest from it; of a cavity both are its widest place. Where the organ is absent,
/// `inside` is empty (size 0). Throws Error{cancelled}.
/// Method: a tube is sought whose sections in axial slices are round, or the widest ball of a cavity; all that hangs
/// together with it between `low_hu` and `high_hu` is grown from it; leaks show as a sudden growth when the limit is
/// raised (explosion control: Mori et al., ICPR 1996), or are cut at their necks by an opening.
/// @param volume as segmentColon() wants it
Segmentation segmentOrgan(const HuVolume& volume, const OrganOptions& options, Progress& progress);

struct TreeResult {
    SkeletonTree tree;
    SkeletonVoxels voxels;  ///< of each branch: 26-connected, from the root; neighbours share their fork
};

/// The skeleton of a lumen that branches, without loops by construction.
/// Method: the shortest paths from the root with findSkeleton()'s cost; the farthest voxel that no path covers yet is a
/// tip (Sato et al., TEASAR, 2000). A tip that reaches less than `branch_mm` beyond the wall of the branch that it
/// leaves is none. Throws Error{bad_input} when nothing is inside, Error{cancelled}.
TreeResult findTree(const InsideVolume& inside, Point3 root_mm, double branch_mm, const SkeletonOptions& options,
                    Progress& progress);

}  // namespace vicon::steps
