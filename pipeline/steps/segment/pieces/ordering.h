#pragma once

#include <functional>
#include <vector>

#include "segment/body.h"
#include "segment/pieces/candidates.h"
#include "vicon/core/progress.h"
#include "vicon/steps/lumen_plan.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {

/// A candidate as the colon runs through it.
struct OrderedPiece {
    int candidate = -1;
    bool reversed = false;  ///< entered through its second tip
};

struct Ordering {
    std::vector<OrderedPiece> pieces;  ///< from the rectum
    std::vector<Bridge> bridges;
};

/// How many millimetres of the best way between two tips are no bowel: fat, bone, gas that belongs to neither piece.
using FatBetween = std::function<double(Point3, Point3)>;

/// The order and direction in which the colon runs through the candidates, starting at the rectal tip of `rectum`.
/// Exact: a dynamic programme over subsets, whose cost is the cheapest way through the CT from tip to tip, the fat on
/// that way when looked at closely, what is left out (length x likeness), and a last end that is not where a caecum
/// lies. `required` candidates must be part of it.
Ordering orderPieces(const std::vector<Candidate>& candidates, int rectum, const std::vector<int>& required,
                     const Body& body, const InsideVolume& labels, const FatBetween& fat_mm,
                     const SegmentOptions& options, Progress& progress);

}  // namespace vicon::steps
