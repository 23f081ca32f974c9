#pragma once

#include <array>

namespace vicon {

/// The tables that hold something of a case, by its `case_id`; those that refer to others come first. Not the audit
/// trail: that stays.
inline constexpr std::array kCaseTables = {"jobs",        "steps",           "instances",  "markers", "findings",
                                           "assessments", "report_versions", "amendments", "outbox",  "comparisons",
                                           "case_words",  "orders",          "scans"};

/// What counters of a case begin with, before its id; those of a scan go on with "/" and its id.
inline constexpr std::array kCaseCounters = {"furthest", "finding", "marker", "markers.json", "report", "picture"};

}  // namespace vicon
