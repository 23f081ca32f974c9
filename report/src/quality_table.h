#pragma once

#include <optional>
#include <string>
#include <vector>

#include "page_flow.h"
#include "vicon/report/content.h"

namespace vicon::report {

namespace look {  // of the tables of quality
inline constexpr TextStyle kCell{7.5, false}, kCellBold{7.5, true};
inline constexpr double kCellRowGap = 0.8;  ///< points
}  // namespace look

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

/// The rows that a table of one scan has, also where the scan does not show a part: the parts and the whole.
std::vector<std::string> partsOfTable();
/// "yes" or "NO".
std::string adequateWord(const QualityTexts& texts);
/// What is not adequate stands out.
Color inkOfQuality(const std::string& text);
/// Whether no part of it is collapsed anywhere.
bool isOpen(const ScanEntry& entry);

}  // namespace vicon::report
