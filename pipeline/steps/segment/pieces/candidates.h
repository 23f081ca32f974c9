#pragma once

#include <vector>

#include "grid/lumen_graph.h"
#include "grid/run_labels.h"
#include "segment/body.h"
#include "vicon/core/enum_names.h"
#include "vicon/core/progress.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// What a candidate looks like, from its width, its length and its place in the body.
enum class CandidateKind { colon, narrow, stomach };
inline constexpr EnumNames<CandidateKind, 3> kCandidateKindNames{{
    {CandidateKind::colon, "colon"},
    {CandidateKind::narrow, "narrow, small bowel or a collapsed part"},
    {CandidateKind::stomach, "stomach"},
}};

/// A part of gas and fluid that may be a piece of the colon: a connected one, or what is left of it without the
/// contacts of its loops.
struct Candidate {
    std::uint32_t label = 0;  ///< its component, which others may share
    double volume_ml = 0;
    double fluid_ml = 0;
    double max_radius_mm = 0;
    double length_mm = 0;              ///< between its tips, along the middle
    Point3 tip_mm[2];                  ///< its two ends; of the piece with the rectum the first is the rectal one
    double tip_radius_mm[2] = {0, 0};  ///< widest radius within 40 mm of each tip
    Point3 lower_mm;                   ///< bounding box
    Point3 upper_mm;
    double colon_likeness = 1;  ///< 0 to 1, from shape and place
    CandidateKind kind = CandidateKind::colon;
    /// Of the component with the rim of fluid that belongs to it, at half resolution.
    LumenGraph graph;
    std::vector<std::uint8_t> barred;  ///< nodes of the graph in contacts or of other candidates; empty: none
};

/// More are not put in order: that takes 2^n steps of 32 n bytes each, here 16 MB.
constexpr int kMostCandidates = 15;

struct FoundCandidates {
    std::vector<Candidate> candidates;
    int left_out = 0;  ///< components that were large enough, but too many
};

/// Measures the components that are large enough to matter, largest first, at most `most` of them and kMostCandidates
/// candidates; those in `always` come before all others, whatever their size.
FoundCandidates findCandidates(const InsideVolume& labels, const RunLabels& lumen, const Body& body, double smallest_ml,
                               int most, const std::vector<int>& always, Progress& progress);

/// The candidate that holds the rectum: low, near the midline, and wide; -1 when there is none. Its first tip becomes
/// the rectal end, above what is narrower than a rectal catheter; the second tip the farthest point from there.
int findRectum(std::vector<Candidate>& candidates, const Body& body, double catheter_radius_mm, Progress& progress);

}  // namespace vicon::steps
