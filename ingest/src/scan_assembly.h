#pragma once

#include <map>
#include <string>
#include <vector>

#include "stack_plan.h"
#include "stored_study.h"

namespace vicon::ingest {

/// A scan or kept series as it is to be stored.
struct AssembledScan {
    Stack stack;
    StackPlan plan;
    ScanRecord record;
    std::vector<const ImageObject*> objects;
    /// A reader has worked on it, or an image of its series cannot be used: its objects, its role and its words stay as
    /// they are.
    bool fixed = false;
    std::string fixed_because;  ///< "which ..."; empty where it is not fixed
    /// Its multi-frame objects share a stack with those of another scan.
    bool is_part = false;
};

/// Puts the objects of a study into scans: first those that are fixed, as they are, then what the rest
/// makes, series by series. Says of each whether it becomes a scan, is kept or refused, and why.
/// @param objects by SOP Instance UID; the scans point to them
std::vector<AssembledScan> assembleScans(const ImportContext& context, const StoredStudy& stored,
                                         const std::map<std::string, ImageObject>& objects);

}  // namespace vicon::ingest
