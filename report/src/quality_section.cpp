// The part of Sections that is about quality: how far open and how wet each part of the colon is, position beside
// position.
#include <algorithm>
#include <array>

#include "quality_table.h"
#include "sections.h"

namespace vicon::report {
namespace {

// Widths in points.
constexpr double kPartWidth = 80, kScanGap = 8;
struct QualityColumn {
    const char* title;
    double width;
};
constexpr std::array<QualityColumn, 4> kColumns = {
    {{"Radius", 44}, {"Fluid", 64}, {"Collapsed", 62}, {"Adequate", 36}}};
constexpr std::size_t kScansBeside = 2;  // as many as a page's width holds

double scanLeft(const PageFlow& flow, std::size_t n)
{
    double width = kScanGap;
    for (const QualityColumn& column : kColumns)
        width += column.width;
    return flow.left() + kPartWidth + double(n) * width;
}

}  // namespace

void Sections::drawQuality()
{
    std::vector<const ScanEntry*> measured;
    for (const ScanEntry& entry : content_.scans)
        if (!qualityRows({&entry}).empty())
            measured.push_back(&entry);
    for (std::size_t n = 0; n < measured.size(); n += kScansBeside)
        drawQualityOf(
            {measured.begin() + long(n), measured.begin() + long(std::min(n + kScansBeside, measured.size()))});
}

void Sections::drawQualityOf(const std::vector<const ScanEntry*>& scans)
{
    const std::vector<QualityRow> rows = qualityRows(scans);
    const double row_height = leadingOf(look::kBody) + 1;
    drawSection(flow_, "Distension and fluid", double(rows.size() + 3) * row_height);
    drawQualityHead(scans);
    for (const QualityRow& row : rows) {
        const TextStyle style = &row == &rows.back() ? look::kBold : look::kBody;
        flow_.put(flow_.left(), flow_.y(), flow_.type.line(row.part, style), look::kInk);
        for (std::size_t n = 0; n < row.scans.size(); ++n) {
            double x = scanLeft(flow_, n);
            const auto put = [&](std::size_t column, const std::string& text, Color ink) {
                flow_.put(x, flow_.y(), flow_.type.line(text, style), ink);
                x += kColumns[column].width;
            };
            if (!row.scans[n]) {
                put(0, "not found", look::kMuted);
                continue;
            }
            put(0, row.scans[n]->radius, look::kInk);
            put(1, row.scans[n]->fluid, look::kInk);
            put(2, row.scans[n]->collapsed, look::kInk);
            put(3, row.scans[n]->adequate ? "yes" : "NO", row.scans[n]->adequate ? look::kInk : look::kNoticeInk);
        }
        flow_.skip(row_height);
    }
    flow_.skip(look::kGap);
}

void Sections::drawQualityHead(const std::vector<const ScanEntry*>& scans)
{
    if (scans.size() > 1) {
        for (std::size_t n = 0; n < scans.size(); ++n)
            flow_.put(scanLeft(flow_, n), flow_.y(), flow_.type.line(scanTitle(*scans[n]), look::kBold), look::kAccent);
        flow_.skip(leadingOf(look::kBold) + 2);
    }
    for (std::size_t n = 0; n < scans.size(); ++n) {
        double x = scanLeft(flow_, n);
        for (const QualityColumn& column : kColumns) {
            flow_.put(x, flow_.y(), flow_.type.line(column.title, look::kSmall), look::kMuted);
            x += column.width;
        }
    }
    flow_.skip(leadingOf(look::kSmall) + 2);
    flow_.pdf.line(flow_.page(), flow_.left(), flow_.y(), scanLeft(flow_, scans.size()) - kScanGap, flow_.y(),
                   look::kThinLine, look::kRule);
    flow_.skip(3);
}

}  // namespace vicon::report
