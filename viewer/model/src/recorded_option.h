#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "vicon/core/scan_records.h"

namespace vicon::viewer {

/// Takes an option's value as the last step had it that was recorded with it; what no step says stays.
inline void takeRecorded(const std::vector<StepRecord>& steps, const char* option, double& value)
{
    for (const StepRecord& step : steps) {
        if (!step.parameters.is_object())
            continue;
        if (const auto said = step.parameters.find(option); said != step.parameters.end() && said->is_number())
            value = said->get<double>();
    }
}

}  // namespace vicon::viewer
