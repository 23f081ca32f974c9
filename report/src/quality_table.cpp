#include "quality_table.h"

#include <algorithm>
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

QualityCells cellsOf(const json& q)
{
    QualityCells out;
    out.radius = whole(numberAt(q, "median_radius_mm"), "mm");
    out.fluid = whole(numberAt(q, "fluid_ml"), "ml") + ", " + percent(numberAt(q, "fluid_fraction"), 0);
    const double collapsed_mm = numberAt(q, "collapsed_mm");
    out.collapsed =
        collapsed_mm > 0 ? whole(collapsed_mm, "mm") + ", " + percent(numberAt(q, "collapsed_fraction"), 0) : "none";
    out.adequate = flagAt(q, "adequate");
    return out;
}

const json* partsOf(const ScanEntry& entry)
{
    if (!entry.quality.is_object() || !entry.quality.contains("median_radius_mm"))
        return nullptr;
    const auto found = entry.quality.find("parts");
    return found != entry.quality.end() && found->is_array() && !found->empty() ? &*found : nullptr;
}

QualityRow& rowOf(std::vector<QualityRow>& rows, const std::string& part, std::size_t scans)
{
    auto found = std::find_if(rows.begin(), rows.end(), [&](const QualityRow& row) { return row.part == part; });
    if (found == rows.end())
        found = rows.insert(rows.end(), {part, std::vector<std::optional<QualityCells>>(scans)});
    return *found;
}

}  // namespace

std::vector<QualityRow> qualityRows(const std::vector<const ScanEntry*>& scans)
{
    std::vector<QualityRow> rows;
    QualityRow total{"whole colon", std::vector<std::optional<QualityCells>>(scans.size())};
    for (std::size_t n = 0; n < scans.size(); ++n) {
        const json* parts = partsOf(*scans[n]);
        if (parts == nullptr)
            continue;
        total.scans[n] = cellsOf(scans[n]->quality);
        for (const json& part : *parts)
            if (part.is_object())
                rowOf(rows, textAt(part, "name"), scans.size()).scans[n] = cellsOf(part);
    }
    if (!rows.empty())
        rows.push_back(std::move(total));
    return rows;
}

}  // namespace vicon::report
