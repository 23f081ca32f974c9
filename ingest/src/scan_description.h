#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "stack_plan.h"
#include "vicon/cases/records.h"

namespace vicon::ingest {

/// The series of a stack; lossy when any of its images is.
Series seriesOf(const Stack& stack);

/// What scan.json says about the grid: that of loadScan().
nlohmann::json describeGeometry(const Stack& stack, const StackPlan& plan);

/// Everything that was mended or assumed, in words, for scan.json.
nlohmann::json describeRepairs(const std::vector<const ImageObject*>& objects, const StackPlan& plan);

/// One line for the user: "430 slices, 1.00 mm apart, prone; queued".
std::string describeInWords(const ScanRecord& record, const StackPlan& plan);

}  // namespace vicon::ingest
