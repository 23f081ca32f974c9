#pragma once

#include <string>

#include "vicon/cases/content_tree.h"
#include "vicon/cases/prior_report.h"
#include "vicon/cases/report_content.h"
#include "vicon/cases/report_versions.h"

namespace vicon::report {

/// Whether a structured report is one of measurements (TID 1500), as VICON writes them.
bool isMeasurementReport(const ContentDocument& document);

/// What a measurement report of any maker says. Groups of one tracking UID are sights of one finding; concepts are
/// known by their codes, else by what they mean in English. Every number has its place or stands among `others`.
PriorReport priorFrom(const ContentDocument& document);

/// The same of a version that this store holds itself.
PriorReport priorFrom(const ReadCase& read, const ReportVersion& version);

}  // namespace vicon::report
