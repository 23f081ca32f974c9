#pragma once

#include <vector>

#include "body.h"
#include "lumen_pieces.h"
#include "vicon/core/progress.h"
#include "vicon/steps/lumen_plan.h"

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

/// The order and direction in which the colon runs through the candidates, starting at the rectal tip of `rectum`.
/// Exact: a dynamic programme over subsets, whose cost is the cheapest way through the CT from tip to tip, what is left
/// out (length x likeness), and a last end that is not where a caecum lies.
/// `required` candidates must be part of it.
Ordering orderPieces(const std::vector<Candidate>& candidates, int rectum, const std::vector<int>& required,
                     const Body& body, const InsideVolume& labels, double longest_sure_mm, Progress& progress);

}  // namespace vicon::steps
