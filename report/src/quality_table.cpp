#include "quality_table.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "vicon/report/wording.h"

namespace vicon::report {
namespace {

constexpr const char *kWhole = "whole colon", *kNotAdequate = "NO";

std::string whole(double value, const char* unit)
{
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.0f %s", value, unit);
    return text.data();
}

QualityTexts textsOf(const StretchQuality& q)
{
    QualityTexts out;
    out.radius = whole(q.median_radius_mm, "mm");
    out.fluid = whole(q.fluid_ml, "ml") + ", " + percent(q.fluidFraction(), 0);
    out.collapsed = q.collapsed_mm > 0 ? whole(q.collapsed_mm, "mm") + ", " + percent(q.collapsed_fraction, 0) : "none";
    out.adequate = q.adequate;
    return out;
}

QualityRow& rowOf(std::vector<QualityRow>& rows, const std::string& part, std::size_t scans)
{
    auto found = std::find_if(rows.begin(), rows.end(), [&](const QualityRow& row) { return row.part == part; });
    if (found == rows.end())
        found = rows.insert(rows.end(), {part, std::vector<std::optional<QualityTexts>>(scans)});
    return *found;
}

}  // namespace

std::vector<QualityRow> qualityRows(const std::vector<const ScanEntry*>& scans)
{
    std::vector<QualityRow> rows;
    QualityRow total{kWhole, std::vector<std::optional<QualityTexts>>(scans.size())};
    for (std::size_t n = 0; n < scans.size(); ++n) {
        const auto& quality = scans[n]->quality;
        if (!quality || quality->parts.empty())
            continue;
        total.scans[n] = textsOf(quality->whole);
        for (const StretchQuality& part : quality->parts)
            rowOf(rows, part.part ? nameOf(*part.part) : "", scans.size()).scans[n] = textsOf(part);
    }
    if (!rows.empty())
        rows.push_back(std::move(total));
    return rows;
}

std::vector<std::string> partsOfTable()
{
    std::vector<std::string> names;
    for (int part = 0; part <= int(ColonPart::caecum); ++part)
        names.push_back(nameOf(ColonPart(part)));
    names.emplace_back(kWhole);
    return names;
}

std::string adequateWord(const QualityTexts& texts)
{
    return texts.adequate ? "yes" : kNotAdequate;
}

Color inkOfQuality(const std::string& text)
{
    return text == kNotAdequate ? look::kNoticeInk : look::kInk;
}

bool isOpen(const ScanEntry& entry)
{
    return entry.quality && entry.quality->whole.adequate && entry.quality->whole.collapsed_mm <= 0;
}

}  // namespace vicon::report
