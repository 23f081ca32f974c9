#include "parts_table.h"

#include <algorithm>

#include "quality_table.h"

namespace vicon::report {
namespace {

constexpr double kBelowTitles = 3;                         // points
constexpr double kLeastNames = 62, kNamesShare = 0.28;     // in points, and of the width
constexpr double kLeastOpen = 158, kLeastCollapsed = 232;  // points
constexpr std::size_t kColumnsOfAnOpenOne = 3;

}  // namespace

PartsTable::PartsTable(Typesetter& type, const ScanEntry& scan, double width) : width_(width)
{
    std::vector<Cell> head;
    for (const char* title : {"", "Radius", "Fluid", "Collapsed", "Adequate"})
        if (!isOpen(scan) || head.size() < kColumnsOfAnOpenOne)
            head.push_back({type.line(title, look::kCell), look::kMuted});
    columns_ = head.size();
    rows_.push_back(std::move(head));
    const std::vector<QualityRow> found = qualityRows({&scan});
    for (const std::string& part : partsOfTable()) {
        const auto at = std::find_if(found.begin(), found.end(), [&](const auto& row) { return row.part == part; });
        const bool whole = !found.empty() && part == found.back().part;
        std::vector<Cell>& row = rows_.emplace_back();
        row.push_back({type.line(part, look::kCell), look::kMuted});
        if (at == found.end() || !at->scans[0]) {
            row.push_back({type.line("not found", look::kCell), look::kMuted});
            continue;
        }
        const QualityTexts& said = *at->scans[0];
        for (const std::string& text : {said.radius, said.fluid, said.collapsed, adequateWord(said)})
            if (row.size() < columns_)
                row.push_back({type.line(text, whole ? look::kCellBold : look::kCell), inkOfQuality(text)});
    }
}

double PartsTable::leastWidth(const ScanEntry& scan)
{
    return isOpen(scan) ? kLeastOpen : kLeastCollapsed;
}

double PartsTable::height() const
{
    return double(rows_.size()) * (leadingOf(look::kCell) + look::kCellRowGap) + kBelowTitles;
}

double PartsTable::leftOf(std::size_t column) const
{
    const double names = std::max(kLeastNames, kNamesShare * width_), others = double(columns_ - 1);
    return column == 0 ? 0 : names + double(column - 1) * (width_ - names) / others;
}

void PartsTable::draw(PageFlow& flow, double x, double y) const
{
    for (const std::vector<Cell>& row : rows_) {
        for (std::size_t n = 0; n < row.size(); ++n)
            flow.put(x + leftOf(n), y, row[n].line, row[n].color);
        y -= leadingOf(look::kCell) + look::kCellRowGap;
        if (&row != &rows_.front())
            continue;
        flow.pdf.line(flow.page(), x, y, x + width_, y, look::kThinLine, look::kRule);
        y -= kBelowTitles;
    }
}

}  // namespace vicon::report
