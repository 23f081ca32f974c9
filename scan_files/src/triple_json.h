#pragma once

#include <nlohmann/json.hpp>

namespace vicon::scan_files {

/// A point or vector as JSON: [x, y, z].
template <class Triple>
nlohmann::json triple(const Triple& t)
{
    return {t.x, t.y, t.z};
}

/// Throws nlohmann::json::exception where there are not three numbers.
template <class Triple>
Triple tripleFrom(const nlohmann::json& j)
{
    return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

}  // namespace vicon::scan_files
