#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vicon/core/option_names.h"
#include "vicon/core/options.h"
#include "vicon/core/progress.h"
#include "vicon/core/skeleton.h"
#include "vicon/core/subdivision.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// thesis: what measures a segment's size.
enum class SegmentSize { surface, inside, triangles };
inline constexpr EnumNames<SegmentSize, 3> kSegmentSizeNames{{
    {SegmentSize::surface, "surface"},
    {SegmentSize::inside, "inside"},
    {SegmentSize::triangles, "triangles"},
}};
constexpr const auto& optionNames(SegmentSize /*value*/)
{
    return kSegmentSizeNames;
}

/// thesis: what tells a good portal.
enum class PortalEffectiveness { tangent, portal_size, gate_ratio };
inline constexpr EnumNames<PortalEffectiveness, 3> kPortalEffectivenessNames{{
    {PortalEffectiveness::tangent, "tangent"},
    {PortalEffectiveness::portal_size, "portal_size"},
    {PortalEffectiveness::gate_ratio, "gate_ratio"},
}};
constexpr const auto& optionNames(PortalEffectiveness /*value*/)
{
    return kPortalEffectivenessNames;
}

/// thesis: how portals are chosen.
enum class SubdivideApproach { local, global };
inline constexpr EnumNames<SubdivideApproach, 2> kSubdivideApproachNames{{
    {SubdivideApproach::local, "local"},
    {SubdivideApproach::global, "global"},
}};
constexpr const auto& optionNames(SubdivideApproach /*value*/)
{
    return kSubdivideApproachNames;
}

/// thesis: which planes are tried.
enum class PlaneDirections { axis, oblique };
inline constexpr EnumNames<PlaneDirections, 2> kPlaneDirectionsNames{{
    {PlaneDirections::axis, "axis"},
    {PlaneDirections::oblique, "oblique"},
}};
constexpr const auto& optionNames(PlaneDirections /*value*/)
{
    return kPlaneDirectionsNames;
}

struct SubdivideOptions {
    SubdivideMethod method = SubdivideMethod::flood;
    int segments = 0;
    double length_mm = 30;
    SegmentSize size = SegmentSize::surface;
    PortalEffectiveness effectiveness = PortalEffectiveness::gate_ratio;
    SubdivideApproach approach = SubdivideApproach::local;
    PlaneDirections planes = PlaneDirections::axis;
    double gate_ratio_low = 0.7;
    double gate_ratio_high = 1.5;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("subdivide.method", method, "", "flood: pieces of the centreline flooded together; thesis: planes across it.",
          choicesOf(method));
        v("subdivide.segments", segments, "", "Specified number of segments; 0 takes it from the length of a segment.",
          OptionLimits{0, 10000});
        v("subdivide.length_mm", length_mm, "mm", "Length of centreline in a segment.", OptionLimits{5, 500});
        v("subdivide.size", size, "", "thesis: what measures a segment's size.", choicesOf(size));
        v("subdivide.effectiveness", effectiveness, "", "thesis: what tells a good portal.", choicesOf(effectiveness));
        v("subdivide.approach", approach, "", "thesis: the local walk of Algorithm 3.1, or the global optimum.",
          choicesOf(approach));
        v("subdivide.planes", planes, "", "thesis: planes along the axes, or across the regional tangent.",
          choicesOf(planes));
        v("subdivide.gate_ratio_low", gate_ratio_low, "", "thesis: least ratio of a good gate's sides.",
          OptionLimits{0, 1});
        v("subdivide.gate_ratio_high", gate_ratio_high, "", "thesis: largest ratio of a good gate's sides.",
          OptionLimits{1, 100});
    }
};

struct Subdivided {
    SegmentVolume segments;  ///< grid of `inside`; 0 outside, 1..N from the rectum
    Subdivision description;
};

/// Which voxel of the skeleton's paths is nearest to each inside voxel, measured inside the lumen.
struct PathFlood {
    std::vector<std::uint32_t> seeds;  ///< offsets of the paths' voxels, one path after the other
    std::vector<std::uint32_t> loose;  ///< offsets of one voxel of each part that no path reaches
    std::vector<std::uint16_t> label;  ///< of every voxel: 1.. for the seeds, then for the loose parts; 0 outside
};

/// The larger part of method "flood", which needs the paths only: it can be made while the curve is still being fitted.
/// @param paths the voxel path of each connected piece, inside
/// Throws Error{bad_input} when paths and loose parts are more than 65535, and Error{no_memory}.
PathFlood floodFromPaths(const InsideVolume& inside, const std::vector<std::vector<Index3>>& paths);

/// Divides the inside voxels into segments. Every inside voxel lies in exactly one segment, each segment is one
/// 26-connected set, none spans a bridge, numbers follow the station, and pieces of a cut that are not connected have
/// numbers of their own. Two segments that touch share exactly one portal; its gate and box enclose everything that
/// the two share, dilated by a voxel diagonal.
///
/// method "flood": the voxel path is cut into pieces of about `length_mm`, all pieces are flooded at once inside the
/// lumen, and each voxel takes the piece whose front reaches it first.
/// method "thesis": Algorithm 3.1 of the thesis with its criteria, and its variants.
///
/// @param flood of the same paths when it was made ahead; otherwise method "flood" makes it
/// The triangle counts of the description are 0 until countTriangles() (cells.h) fills them in.
/// Throws Error{bad_input} when nothing is inside or the skeleton is empty, or when more segments than 65535 result.
Subdivided subdivide(const InsideVolume& inside, const Skeleton& skeleton, const SkeletonVoxels& voxels,
                     const SubdivideOptions& options, Progress& progress, std::optional<PathFlood> flood = {});

/// A cavity without a path: one segment, and one of its own for every part that is not 26-connected to the largest;
/// no method, stations 0. Throws Error{bad_input} when nothing is inside.
Subdivided undivided(const InsideVolume& inside, const SubdivideOptions& options, Progress& progress);

}  // namespace vicon::steps
