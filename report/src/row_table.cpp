#include "row_table.h"

#include <algorithm>

namespace vicon::report {
namespace {

constexpr double kRowGap_pt = 2.5, kCellGap_pt = 4, kBelowRule_pt = 3;
constexpr std::size_t kMostLines = 2;  // of a cell

}  // namespace

TextLine cutTo(Typesetter& type, const std::string& text, TextStyle style, double width)
{
    const std::vector<TextLine> lines = type.lines(text, style, width);
    if (lines.size() == 1)
        return lines.front();
    const TextLine dots = type.line("\u2026", style);
    TextLine cut = type.lines(text, style, width - dots.width).front();
    cut.append(dots);
    return cut;
}

double RowTable::headHeight()
{
    return leadingOf(look::kSmall) + 2 + kBelowRule_pt;
}

std::vector<TextLine> RowTable::linesOf(std::size_t column, const std::string& cell) const
{
    const double width = right(column) - left(column) - kCellGap_pt;
    std::vector<TextLine> lines = flow_.type.lines(cell, look::kBody, width);
    if (lines.size() > kMostLines)  // cut, as whole as it can be
        lines = {cutTo(flow_.type, cell, look::kBody, width)};
    return lines;
}

double RowTable::rowHeight(const std::vector<std::string>& cells) const
{
    std::size_t lines = 1;
    for (std::size_t n = 0; n < cells.size(); ++n)
        lines = std::max(lines, linesOf(n, cells[n]).size());
    return double(lines) * leadingOf(look::kBody) + kRowGap_pt;
}

void RowTable::drawHead()
{
    for (std::size_t n = 0; n < columns_.size(); ++n)
        flow_.put(left(n), flow_.y(), flow_.type.line(columns_[n].title, look::kSmall), look::kMuted);
    flow_.skip(leadingOf(look::kSmall) + 2);
    flow_.pdf.line(flow_.page(), flow_.left(), flow_.y(), flow_.left() + flow_.width(), flow_.y(), look::kThinLine,
                   look::kRule);
    flow_.skip(kBelowRule_pt);
}

void RowTable::beginRow(const std::vector<std::string>& cells)
{
    if (rowHeight(cells) <= flow_.room())
        return;
    flow_.newPage();
    drawHead();
}

void RowTable::drawRow(const std::vector<std::string>& cells)
{
    for (std::size_t n = 0; n < cells.size(); ++n) {
        double y = flow_.y();
        for (const TextLine& line : linesOf(n, cells[n])) {
            flow_.put(left(n), y, line, look::kInk);
            y -= leadingOf(look::kBody);
        }
    }
    flow_.skip(rowHeight(cells));
}

}  // namespace vicon::report
