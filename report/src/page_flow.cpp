#include "page_flow.h"

namespace vicon::report {

void PageFlow::newPage()
{
    wanted_.check();
    page_ = pdf.addPage(paper_.width, paper_.height);
    y_ = paper_.height - paper_.top;
}

void PageFlow::need(double height)
{
    if (height > room() && !atTop())
        newPage();
}

void PageFlow::put(double x, double y, const TextLine& line, Color color)
{
    pdf.text(page_, x, y - line.size * look::kAscent, line, color);
}

void PageFlow::putRight(double right, double y, const TextLine& line, Color color)
{
    put(right - line.width, y, line, color);
}

void PageFlow::paragraph(double x, double width, const std::vector<TextLine>& lines, TextStyle style, Color color)
{
    for (const TextLine& line : lines) {
        need(leadingOf(style));
        put(line.right_to_left ? x + width - line.width : x, y_, line, color);
        skip(leadingOf(style));
    }
}

}  // namespace vicon::report
