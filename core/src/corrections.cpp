#include "vicon/core/corrections.h"

#include "vicon/core/geometry_json.h"

using nlohmann::json;

namespace vicon {

std::string nameOf(Correction kind)
{
    switch (kind) {
        case Correction::add:
            return "add";
        case Correction::cut:
            return "cut";
        case Correction::drop:
            return "drop";
    }
    return "add";
}

std::vector<Point3>& Corrections::of(Correction kind)
{
    return kind == Correction::add ? add : kind == Correction::cut ? cut : drop;
}

const std::vector<Point3>& Corrections::of(Correction kind) const
{
    return kind == Correction::add ? add : kind == Correction::cut ? cut : drop;
}

json toJson(const Corrections& corrections)
{
    json out;
    for (const Correction kind : kCorrections)
        out[nameOf(kind)] = corrections.of(kind);
    return out;
}

Corrections correctionsFromJson(const json& json)
{
    Corrections corrections;
    for (const Correction kind : kCorrections)
        corrections.of(kind) = json.value(nameOf(kind), nlohmann::json::array()).get<std::vector<Point3>>();
    return corrections;
}

}  // namespace vicon
