#include "strip_chart.h"

#include <algorithm>
#include <cmath>

namespace vicon::report {
namespace {

constexpr Color kGas{0.87F, 0.90F, 0.93F}, kFluid{0.47F, 0.67F, 0.86F}, kWall{0.35F, 0.40F, 0.46F};
constexpr Color kCollapsed{0.97F, 0.83F, 0.80F}, kCollapsedInk{0.72F, 0.12F, 0.10F}, kWhite{1, 1, 1};
constexpr Color kBetweenParts{0.62F, 0.66F, 0.70F};
constexpr Color kPartFills[] = {{0.80F, 0.83F, 0.87F}, {0.90F, 0.92F, 0.94F}};  // of neighbours in turn

// Points.
constexpr double kScaleWidth = 28;  // left of the colon, for the figures of the scale
constexpr double kPartBand = 3, kWallLine = 0.5, kHair = 0.4, kLeastCollapsed = 1.2;
constexpr double kMarkRadius = 5.5, kMarkGap = 1.5, kWordGap = 3, kPanelGap = 5, kTick = 2.5;
const TextStyle kLabel{7, false}, kMarkLabel{7, true};

constexpr double kScale_mm = 10;   // the scale ends at a whole number of these
constexpr double kTicks_mm = 200;  // along the colon

/// The largest but for the few at the colon's ends: there all of the lumen beyond belongs to one place.
double usualMost(std::vector<double> radii_mm)
{
    constexpr double kUsual = 0.97;
    if (radii_mm.empty())
        return 0;
    const auto at = radii_mm.begin() + std::ptrdiff_t(kUsual * double(radii_mm.size() - 1));
    std::nth_element(radii_mm.begin(), at, radii_mm.end());
    return *at;
}

double markHeight(std::size_t rows)
{
    return double(rows) * (2 * kMarkRadius + kMarkGap);
}

/// The flexures are short.
std::string shortNameOf(ColonPart part)
{
    return part == ColonPart::splenic_flexure   ? "spl. fl."
           : part == ColonPart::hepatic_flexure ? "hep. fl."
                                                : nameOf(part);
}

/// The first row in which [left, right] is free; `ends` has where each row is taken up to.
std::size_t rowFor(std::vector<double>& ends, double left, double right)
{
    std::size_t row = 0;
    while (row < ends.size() && ends[row] > left)
        ++row;
    if (row == ends.size())
        ends.push_back(0);
    ends[row] = right;
    return row;
}

}  // namespace

StripChart::StripChart(Typesetter& type, const std::vector<StripColon>& colons, double width, double half_height)
    : width_(width), half_height_(half_height)
{
    widest_mm_ = kScale_mm;
    for (const StripColon& colon : colons) {
        longest_mm_ = std::max(longest_mm_, colon.length_mm);
        widest_mm_ = std::max(widest_mm_, std::ceil(usualMost(colon.along.radius_mm) / kScale_mm) * kScale_mm);
    }
    for (const StripColon& colon : colons)
        panels_.push_back(panelOf(type, colon));
}

double StripChart::xAt(double station_mm) const
{
    return look::kMargin + kScaleWidth + (width_ - kScaleWidth) * station_mm / longest_mm_;
}

StripChart::Panel StripChart::panelOf(Typesetter& type, const StripColon& colon) const
{
    Panel panel{.colon = colon, .title = type.line(colon.title, look::kBold)};
    if (!colon.about.empty())
        panel.about = type.lines(colon.about, kLabel, width_);
    const double right = look::kMargin + width_;
    std::vector<double> ends;
    for (const ColonPartRange& part : colon.parts) {
        const TextLine line = type.line(shortNameOf(part.part), kLabel);
        const double half = line.width / 2;
        const double x = std::clamp(xAt((part.from_mm + part.to_mm) / 2), xAt(0) + half, right - half);
        panel.names.push_back({line, x, rowFor(ends, x - half, x + half + kWordGap)});
    }
    panel.name_rows = ends.size();
    ends.clear();
    std::vector<StripMark> marks = colon.marks;
    std::stable_sort(marks.begin(), marks.end(),
                     [](const StripMark& a, const StripMark& b) { return a.station_mm < b.station_mm; });
    for (const StripMark& mark : marks) {
        const double x = std::min(xAt(mark.station_mm), right - kMarkRadius);
        const std::size_t row = rowFor(ends, x - kMarkRadius, x + kMarkRadius + kMarkGap);
        panel.marks.push_back({type.line(mark.label, kMarkLabel), x, row});
    }
    panel.mark_rows = ends.size();
    return panel;
}

double StripChart::heightOf(const Panel& panel) const
{
    return leadingOf(look::kBold) + double(panel.about.size()) * leadingOf(kLabel) + markHeight(panel.mark_rows) + 2 +
           2 * half_height_ + kPartBand + double(panel.name_rows) * leadingOf(kLabel) + kPanelGap;
}

double StripChart::height() const
{
    double height = leadingOf(kLabel) + kTick;
    for (const Panel& panel : panels_)
        height += heightOf(panel);
    return height;
}

void StripChart::draw(PageFlow& flow) const
{
    for (const Panel& panel : panels_) {
        drawPanel(flow, panel);
        flow.skip(heightOf(panel));
    }
    drawAxis(flow);
    flow.skip(leadingOf(kLabel) + kTick);
}

void StripChart::drawPanel(PageFlow& flow, const Panel& panel) const
{
    const double bottom =
        flow.y() - heightOf(panel) + kPanelGap + double(panel.name_rows) * leadingOf(kLabel) + kPartBand;
    const double middle = bottom + half_height_, top = bottom + 2 * half_height_;
    double y = top + 2 + markHeight(panel.mark_rows) + double(panel.about.size()) * leadingOf(kLabel);
    flow.put(flow.left(), y + leadingOf(look::kBold), panel.title, look::kAccent);
    for (const TextLine& line : panel.about) {
        flow.put(flow.left(), y, line, look::kMuted);
        y -= leadingOf(kLabel);
    }
    for (const StationRange& range : panel.colon.along.collapsed) {
        const double width = std::max(kLeastCollapsed, xAt(range.to_mm) - xAt(range.from_mm));
        flow.pdf.fill(flow.page(), {xAt(range.from_mm), bottom, width, 2 * half_height_}, kCollapsed);
    }
    drawScale(flow, panel.colon, middle);
    drawLumen(flow, panel.colon, middle);
    for (const StationRange& range : panel.colon.along.collapsed) {
        const double from = xAt(range.from_mm);
        flow.pdf.line(flow.page(), from, middle, std::max(from + kLeastCollapsed, xAt(range.to_mm)), middle,
                      2 * look::kThinLine, kCollapsedInk);
    }
    drawParts(flow, panel, bottom);
    drawMarks(flow, panel, top, middle);
}

void StripChart::drawScale(PageFlow& flow, const StripColon& colon, double middle) const
{
    const double right = xAt(colon.length_mm);
    for (const double share : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
        const double y = middle + share * half_height_;
        flow.pdf.line(flow.page(), xAt(0), y, right, y, kHair, look::kRule);
        if (share < 0 || share == 0.5)
            continue;
        const TextLine figure =
            flow.type.line(std::to_string(std::lround(share * widest_mm_)) + (share > 0 ? " mm" : ""), kLabel);
        flow.putRight(xAt(0) - kTick, y + 0.6 * figure.size, figure, look::kMuted);
    }
}

void StripChart::drawLumen(PageFlow& flow, const StripColon& colon, double middle) const
{
    const LumenAlong& along = colon.along;
    std::vector<Corner> top, level, bottom;
    for (std::size_t n = 0; n < along.radius_mm.size(); ++n) {
        const double x = xAt(std::min((double(n) + 0.5) * along.step_mm, colon.length_mm));
        const double half = std::min(along.radius_mm[n] / widest_mm_, 1.0) * half_height_;
        top.push_back({x, middle + half});
        bottom.push_back({x, middle - half});
        level.push_back({x, middle - half + 2 * half * along.fluid_fraction[n]});
    }
    const auto fillBetween = [&](std::vector<Corner> upper, const std::vector<Corner>& lower, Color color) {
        upper.insert(upper.end(), lower.rbegin(), lower.rend());
        flow.pdf.polygon(flow.page(), upper, color);
    };
    fillBetween(top, bottom, kGas);
    fillBetween(level, bottom, kFluid);
    for (const auto* wall : {&top, &bottom})
        for (std::size_t n = 1; n < wall->size(); ++n)
            flow.pdf.line(flow.page(), (*wall)[n - 1].x, (*wall)[n - 1].y, (*wall)[n].x, (*wall)[n].y, kWallLine,
                          kWall);
}

void StripChart::drawParts(PageFlow& flow, const Panel& panel, double bottom) const
{
    std::size_t n = 0;
    for (const ColonPartRange& part : panel.colon.parts) {
        const double from = xAt(part.from_mm), to = xAt(std::min(part.to_mm, panel.colon.length_mm));
        flow.pdf.fill(flow.page(), {from, bottom - kPartBand, to - from, kPartBand}, kPartFills[n++ % 2]);
        if (part.from_mm > 0)
            flow.pdf.line(flow.page(), from, bottom - kPartBand, from, bottom + 2 * half_height_, kHair, kBetweenParts);
    }
    for (const Placed& name : panel.names)
        flow.put(name.x - name.line.width / 2, bottom - kPartBand - double(name.row) * leadingOf(kLabel), name.line,
                 look::kMuted);
}

void StripChart::drawMarks(PageFlow& flow, const Panel& panel, double top, double middle) const
{
    for (const Placed& mark : panel.marks) {
        const double y = top + 2 + kMarkRadius + markHeight(mark.row);
        flow.pdf.line(flow.page(), mark.x, y, mark.x, middle, look::kThinLine, look::kAccent);
    }
    for (const Placed& mark : panel.marks) {
        const double y = top + 2 + kMarkRadius + markHeight(mark.row);
        flow.pdf.disc(flow.page(), mark.x, y, kMarkRadius, look::kAccent);
        flow.pdf.text(flow.page(), mark.x - mark.line.width / 2, y - 0.35 * mark.line.size, mark.line, kWhite);
    }
}

void StripChart::drawAxis(PageFlow& flow) const
{
    const double y = flow.y() + kPanelGap;
    flow.pdf.line(flow.page(), xAt(0), y, xAt(longest_mm_), y, kHair, look::kMuted);
    double free_from = 0;
    for (double station_mm = 0; station_mm <= longest_mm_; station_mm += kTicks_mm) {
        const double x = xAt(station_mm);
        flow.pdf.line(flow.page(), x, y, x, y - kTick, kHair, look::kMuted);
        const TextLine figure = flow.type.line(std::to_string(std::lround(station_mm / 10)), kLabel);
        const double left = std::min(x - figure.width / 2, look::kMargin + width_ - figure.width);
        if (left < free_from)
            continue;
        free_from = left + figure.width + kWordGap;
        flow.put(left, y - kTick, figure, look::kMuted);
    }
    flow.put(flow.left(), y - kTick, flow.type.line("cm", kLabel), look::kMuted);
}

}  // namespace vicon::report
