#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vicon/report/content.h"

namespace vicon::report {

/// What the table of quality says of one part of the colon in one scan.
struct QualityTexts {
    std::string radius;     ///< "25 mm", the median
    std::string fluid;      ///< "146 ml, 31 %"
    std::string collapsed;  ///< "14 mm, 3 %" or "none"
    bool adequate = false;
};

/// A part of the colon, or the whole, in each scan that measures it: a part that one position does not show may be
/// shown by the other.
struct QualityRow {
    std::string part;
    std::vector<std::optional<QualityTexts>> scans;  ///< as many as were asked for, in their order
};

/// The parts in the order in which the scans name them, then "whole colon"; nothing when no scan measures its parts.
std::vector<QualityRow> qualityRows(const std::vector<const ScanEntry*>& scans);

}  // namespace vicon::report
