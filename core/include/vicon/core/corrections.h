#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon {

/// What a person says about the lumen at a point: the gas or fluid here belongs to the colon; the lumen is cut here,
/// and the smaller part is dropped; the piece here does not belong to the colon.
enum class Correction { add, cut, drop };
inline constexpr Correction kCorrections[] = {Correction::add, Correction::cut, Correction::drop};
/// "add", "cut" or "drop".
std::string nameOf(Correction kind);

/// All that a person said about the lumen of one scan, as points in LPS mm.
struct Corrections {
    std::vector<Point3> add, cut, drop;

    std::vector<Point3>& of(Correction kind);
    const std::vector<Point3>& of(Correction kind) const;
    bool empty() const { return add.empty() && cut.empty() && drop.empty(); }
    bool operator==(const Corrections&) const = default;
};

/// {"add": [[x, y, z], ...], "cut": ..., "drop": ...}, as docs/dev/schemas/corrections.schema.json has it.
nlohmann::json toJson(const Corrections& corrections);
/// Throws nlohmann::json::exception where it is not such an object; a missing list is an empty one.
Corrections correctionsFromJson(const nlohmann::json& json);

}  // namespace vicon
