#include "quality_words.h"

#include <array>
#include <cstdio>

#include "describe_json.h"
#include "vicon/report/wording.h"

using nlohmann::json;

namespace vicon::report {
namespace {

std::string whole(double value, const char* unit)
{
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.0f %s", value, unit);
    return text.data();
}

bool isTrue(const json& object, const char* key)
{
    const auto found = object.find(key);
    return found != object.end() && found->is_boolean() && found->get<bool>();
}

std::string stretchWords(const json& q)
{
    std::string out = "radius " + whole(numberAt(q, "median_radius_mm"), "mm") + ", fluid " +
                      whole(numberAt(q, "fluid_ml"), "ml") + " (" + percent(numberAt(q, "fluid_fraction"), 0) + ")";
    if (const double collapsed_mm = numberAt(q, "collapsed_mm"); collapsed_mm > 0)
        out += ", collapsed over " + whole(collapsed_mm, "mm") + " (" + percent(numberAt(q, "collapsed_fraction"), 0) +
               ")";
    return out;
}

}  // namespace

std::string qualityWords(const json& quality)
{
    if (!quality.is_object() || !quality.contains("adequate") || !quality.contains("median_radius_mm"))
        return joinedLines(describeMeasures(quality));
    std::string out = isTrue(quality, "adequate") ? "adequate" : "NOT ADEQUATE";
    if (const std::string reason = textAt(quality, "reason"); !reason.empty())
        out += ": " + reason;
    out += "\nwhole colon: " + stretchWords(quality) + ", noise " + whole(numberAt(quality, "noise_hu"), "HU");
    const auto parts = quality.find("parts");
    if (parts != quality.end() && parts->is_array())
        for (const json& part : *parts)
            if (part.is_object())
                out += "\n" + textAt(part, "name") + ": " + stretchWords(part) +
                       (isTrue(part, "adequate") ? "" : ", NOT ADEQUATE");
    return out;
}

}  // namespace vicon::report
