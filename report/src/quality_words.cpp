#include "quality_words.h"

#include <array>
#include <cstdio>

#include "describe_json.h"

using nlohmann::json;

namespace vicon::report {

std::string qualityWords(const json& quality)
{
    if (!quality.is_object() || !quality.contains("adequate") || !quality.contains("median_radius_mm"))
        return joinedLines(describeMeasures(quality));
    std::string out = flagAt(quality, "adequate") ? "adequate" : "NOT ADEQUATE";
    if (const std::string reason = textAt(quality, "reason"); !reason.empty())
        out += ": " + reason;
    std::array<char, 48> noise{};
    std::snprintf(noise.data(), noise.size(), "\nnoise %.0f HU", numberAt(quality, "noise_hu"));
    return out + noise.data();
}

}  // namespace vicon::report
