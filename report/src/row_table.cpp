#include "row_table.h"

namespace vicon::report {
namespace {

constexpr double kRowGap_pt = 2.5, kCellGap_pt = 4, kBelowRule_pt = 3;

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

double RowTable::rowHeight()
{
    return leadingOf(look::kBody) + kRowGap_pt;
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

void RowTable::beginRow()
{
    if (rowHeight() <= flow_.room())
        return;
    flow_.newPage();
    drawHead();
}

void RowTable::drawRow(const std::vector<std::string>& cells)
{
    for (std::size_t n = 0; n < cells.size(); ++n)
        flow_.put(left(n), flow_.y(), cutTo(flow_.type, cells[n], look::kBody, right(n) - left(n) - kCellGap_pt),
                  look::kInk);
    flow_.skip(rowHeight());
}

}  // namespace vicon::report
