#pragma once

#include <optional>
#include <string>

#include "vicon/cases/assessment.h"

namespace vicon {

/// What VICON knows of a study without its reader: it is offered, and said once the reader takes it.
struct KnownStudy {
    std::string indication, technique;
    std::optional<double> dose_mgy_cm;
    std::optional<double> reading_minutes, coverage_percent;
    std::string fluid;  ///< how much tagged fluid is where, in words: to judge preparation and tagging by
};

/// Fills in what was not said yet; what was stays.
void fillIn(Assessment& said, const KnownStudy& known);

}  // namespace vicon
