#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon {

/// The way over a collapsed part, from the caecal end of one piece of lumen to the rectal end of the next.
struct Bridge {
    Point3 from_mm;
    Point3 to_mm;
    std::vector<Point3> path_mm;  ///< from `from_mm` to `to_mm`, both included; empty where only the ends are known
    double length_mm = 0;         ///< of the path
    double confidence = 0;        ///< 0 to 1
    std::string reason;           ///< why the confidence is what it is, for a person
    bool certain = false;
};

/// {"from_mm", "to_mm", "length_mm", "confidence", "reason", "certain"}, and "path_mm" where there is one.
nlohmann::json toJson(const Bridge& bridge);
/// Throws nlohmann::json::exception when a key is missing or of the wrong type.
Bridge bridgeFromJson(const nlohmann::json& json);

/// Whether two bridges join the same places: of the same scan, as two readers or two runs saw it.
bool isSameBridge(const Bridge& a, const Bridge& b);

}  // namespace vicon
