#pragma once

#include "vicon/cases/content_tree.h"
#include "vicon/cases/prior_report.h"

namespace vicon::report {

/// Nothing where it is no length, or one below nothing.
std::optional<double> inMillimetres(const ContentItem& item);

/// What a measurement group says, added to what is known of its finding, and of the scan that shows it.
void readGroup(const ContentItem& group, const ContentDocument& document, PriorFinding& finding, PriorSight& sight);

}  // namespace vicon::report
