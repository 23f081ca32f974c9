#pragma once

#include <nlohmann/json.hpp>

#include "vicon/core/options.h"
#include "vicon/steps/organ.h"

namespace vicon::pipeline {

/// Parameters of a step from the options structs it uses.
template <class... Options>
nlohmann::json parametersFrom(const Config& config)
{
    nlohmann::json all = nlohmann::json::object();
    (all.update(toJson(config.get<Options>())), ...);
    return all;
}

inline bool isColon(const Config& config)
{
    return config.get<steps::OrganOptions>().isColon();
}

/// Whether a path leads through the organ.
inline bool hasPath(const Config& config)
{
    return config.get<steps::OrganOptions>().hasPath();
}

/// Parameters of a step that other organs go through too; the colon's do not depend on options of other organs.
template <class OfColon, class OfOthers>
nlohmann::json parametersByOrgan(const Config& config)
{
    nlohmann::json all = isColon(config) ? parametersFrom<OfColon>(config) : parametersFrom<OfOthers>(config);
    if (!isColon(config))
        all.update(parametersFrom<steps::OrganOptions>(config));
    return all;
}

}  // namespace vicon::pipeline
