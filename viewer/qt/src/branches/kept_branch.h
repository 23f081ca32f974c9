#pragma once

#include <string>

#include "reading/kept_place.h"

namespace vicon::viewer {

inline QString keptBranchKey(const CaseRecord& record, const std::string& scan_id)
{
    return keptKey(record, "way_" + QString::fromStdString(scan_id));
}

/// The number of the branch whose tip this reader chose last; below 0: the farthest.
int keptBranch(const CaseRecord& record, const std::string& scan_id);

}  // namespace vicon::viewer
