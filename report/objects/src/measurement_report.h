#pragma once

#include "measurement_groups.h"
#include "vicon/report/report_objects.h"

namespace vicon::report {

/// The measurement report: TID 1500 in a Comprehensive 3D SR.
ReportObject writeMeasurementReport(const ObjectContent& content, const MarkerImages& images,
                                    const std::vector<Centreline>& centrelines, const std::filesystem::path& folder);

/// The slices that show findings, as Key Object Selection "Of Interest". There must be some.
ReportObject writeKeyImages(const ObjectContent& content, const MarkerImages& images,
                            const std::filesystem::path& folder);

}  // namespace vicon::report
