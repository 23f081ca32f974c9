// The part of Sections that is about quality: how far open and how wet each part of the colon is, position below
// position.
#include <algorithm>

#include "quality_table.h"
#include "sections.h"
#include "strip_chart.h"
#include "vicon/report/wording.h"

namespace vicon::report {
namespace {

// Of the table, with a column for each part: points.
constexpr double kLabelWidth = 52, kLastWidth = 60, kCellGap = 3;
constexpr std::size_t kParts = std::size_t(ColonPart::caecum) + 1;

// Of the colons laid straight: as much as the page has, within these. Points, from the middle to the largest radius.
constexpr double kLeastHalf = 9, kMostHalf = 30, kBelowStrips = 6;
constexpr double kBelowHead = 5;  ///< of the table

/// What the numbers and colours of the chart mean.
std::string stripLegend(const std::vector<const ScanEntry*>& scans, bool marked)
{
    std::string out =
        "From the rectum, laid straight and as wide as the disc of its cross-section. Blue: tagged fluid.";
    for (const ScanEntry* entry : scans)
        if (!entry->quality->along.collapsed.empty()) {
            out += " Red: collapsed, under " +
                   millimetres(entry->quality->thresholds.value("quality.collapsed_radius_mm", 0.0), 1) + " of radius.";
            break;
        }
    return out + (marked ? " Numbers: findings." : "");
}

}  // namespace

std::vector<const ScanEntry*> Sections::measuredScans() const
{
    std::vector<const ScanEntry*> measured;
    for (const ScanEntry& entry : content_.scans)
        if (!parts_told_ && !qualityRows({&entry}).empty())
            measured.push_back(&entry);
    return measured;
}

void Sections::drawQuality()
{
    const bool strips = drawStrips(tailHeight());
    drawParts(!strips || partRowsHeight() > flow_.room());
}

void Sections::drawQualityOnPageOne()
{
    const double heading = leadingOf(look::kSection) + 8;
    if (qualityHeight() <= flow_.room())
        drawQuality();
    else if (!strips().empty() && heading + stripsHeight() <= flow_.room())
        drawStrips(0);
    else if (heading + partRowsHeight() <= flow_.room())
        drawParts(true);
}

void Sections::drawParts(bool headed)
{
    const std::vector<const ScanEntry*> measured = measuredScans();
    if (measured.empty())
        return;
    if (headed)
        drawSection(flow_, "Distension and fluid of each segment", std::min(partRowsHeight(), flow_.wholePage() / 2));
    drawPartHead();
    for (const ScanEntry* entry : measured) {
        if (scanRowsHeight(*entry) > flow_.room()) {
            flow_.startPage();
            drawPartHead();
        }
        drawScanRows(*entry);
    }
    flow_.skip(look::kGap / 2);
    parts_told_ = true;
}

StripColon Sections::stripOf(const ScanEntry& entry) const
{
    StripColon colon{.title = scanTitle(entry),
                     .about = scansToldInStrips() ? briefStatement(entry).text : "",
                     .along = entry.quality->along,
                     .parts = entry.parts,
                     .length_mm = entry.skeleton_length_mm,
                     .marks = {}};
    for (const FindingWithFacts& f : content_.read.findings)
        for (const FindingSight& sight : f.facts.sights)
            if (sight.scan_id == entry.scan.id)
                colon.marks.push_back({std::to_string(f.finding.number()), sight.station_mm});
    return colon;
}

bool Sections::scansToldInStrips() const
{
    return isQuiet() && stripScans().size() == content_.scans.size() &&
           std::all_of(content_.scans.begin(), content_.scans.end(), isPlain);
}

std::vector<const ScanEntry*> Sections::stripScans() const
{
    std::vector<const ScanEntry*> out;
    for (const ScanEntry& entry : content_.scans)
        if (entry.quality && !entry.quality->along.radius_mm.empty() && entry.skeleton_length_mm > 0)
            out.push_back(&entry);
    return out;
}

std::vector<StripColon> Sections::strips() const
{
    std::vector<StripColon> colons;
    if (strips_told_)
        return colons;
    for (const ScanEntry* entry : stripScans())
        colons.push_back(stripOf(*entry));
    return colons;
}

double Sections::qualityHeight() const
{
    return leadingOf(look::kSection) + 8 + partRowsHeight() + look::kGap + stripsHeight();
}

double Sections::stripsHeight() const
{
    const std::vector<StripColon> colons = strips();
    return colons.empty() ? 0
                          : leadingOf(look::kSmall) * 2 + kBelowStrips +
                                StripChart(flow_.type, colons, flow_.width(), kLeastHalf + 4).height();
}

bool Sections::drawStrips(double below)
{
    const std::vector<StripColon> colons = strips();
    if (colons.empty())
        return false;
    const auto legend =
        flow_.type.lines(stripLegend(stripScans(), !content_.read.findings.empty()), look::kSmall, flow_.width());
    const double words = double(legend.size()) * leadingOf(look::kSmall);
    const double least = StripChart(flow_.type, colons, flow_.width(), kLeastHalf).height();
    constexpr double kSlack = 2;  // sums in another order differ in their last digit
    const double spare = flow_.room() - leadingOf(look::kSection) - 8 - words - kBelowStrips - least - below - kSlack;
    const double half = spare < 0 && !isQuiet()
                            ? kMostHalf
                            : std::clamp(kLeastHalf + spare / (2 * double(colons.size())), kLeastHalf, kMostHalf);
    const StripChart chart(flow_.type, colons, flow_.width(), half);
    drawSection(flow_, "Distension and fluid along the colon", words + chart.height());
    flow_.paragraph(flow_.left(), flow_.width(), legend, look::kSmall, look::kMuted);
    chart.draw(flow_);
    flow_.skip(kBelowStrips);
    strips_told_ = true;
    return true;
}

/// What follows the chart on its page: where nothing was found, the whole rest.
double Sections::tailHeight() const
{
    return partRowsHeight() + look::kGap / 2 + (isQuiet() ? endHeight() : 0);
}

double Sections::endHeight() const
{
    return leadingOf(look::kBold) + (scansToldInStrips() ? 0 : briefScansHeight());
}

double Sections::partRowsHeight() const
{
    const std::vector<const ScanEntry*> measured = measuredScans();
    double height = measured.empty() ? 0 : partHeadHeight();
    for (const ScanEntry* entry : measured)
        height += scanRowsHeight(*entry);
    return height;
}

double Sections::partColumn(std::size_t n) const
{
    return flow_.left() + kLabelWidth + double(n) * (flow_.width() - kLabelWidth - kLastWidth) / double(kParts);
}

double Sections::partHeadHeight()
{
    return 2 * leadingOf(look::kCell) + kBelowHead;  // the flexures take two lines
}

void Sections::drawPartHead()
{
    for (std::size_t n = 0; n <= kParts; ++n) {
        const std::string name = partsOfTable()[n];
        const double width = (n < kParts ? partColumn(n + 1) : flow_.left() + flow_.width()) - partColumn(n) - kCellGap;
        const auto lines = flow_.type.lines(name, look::kCell, width);
        double y = flow_.y() - double(2 - std::min<std::size_t>(2, lines.size())) * leadingOf(look::kCell);
        for (const TextLine& line : lines) {
            flow_.put(partColumn(n), y, line, look::kMuted);
            y -= leadingOf(look::kCell);
        }
    }
    flow_.skip(2 * leadingOf(look::kCell) + 2);  // then the rule
    flow_.pdf.line(flow_.page(), flow_.left(), flow_.y(), flow_.left() + flow_.width(), flow_.y(), look::kThinLine,
                   look::kRule);
    flow_.skip(kBelowHead - 2);
}

double Sections::scanRowsHeight(const ScanEntry& entry) const
{
    constexpr double kWithTitle = 3;  // title, radius, fluid
    return (kWithTitle + (isOpen(entry) ? 0 : 2)) * (leadingOf(look::kCell) + look::kCellRowGap) + 2;
}

void Sections::drawScanRows(const ScanEntry& entry)
{
    const double row_height = leadingOf(look::kCell) + look::kCellRowGap;
    flow_.put(flow_.left(), flow_.y(), flow_.type.line(scanTitle(entry), look::kCellBold), look::kAccent);
    flow_.skip(row_height);
    const std::vector<QualityRow> rows = qualityRows({&entry});
    const auto drawRow = [&](const char* label, auto&& cellOf) {
        flow_.put(flow_.left(), flow_.y(), flow_.type.line(label, look::kCell), look::kMuted);
        for (std::size_t n = 0; n <= kParts; ++n) {
            const std::string part = partsOfTable()[n];
            const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.part == part; });
            const bool found = row != rows.end() && row->scans[0];
            const std::string text = found ? cellOf(*row->scans[0]) : "not found";
            flow_.put(partColumn(n), flow_.y(), flow_.type.line(text, n < kParts ? look::kCell : look::kCellBold),
                      found ? inkOfQuality(text) : look::kMuted);
        }
        flow_.skip(row_height);
    };
    drawRow("Radius", [](const QualityTexts& texts) { return texts.radius; });
    drawRow("Fluid", [](const QualityTexts& texts) { return texts.fluid; });
    if (!isOpen(entry)) {
        drawRow("Collapsed", [](const QualityTexts& texts) { return texts.collapsed; });
        drawRow("Adequate", adequateWord);
    }
    flow_.skip(2);
}

}  // namespace vicon::report
