// The part of Sections that is about findings.
#include <algorithm>
#include <array>
#include <cmath>

#include "row_table.h"
#include "sections.h"
#include "vicon/report/finding_statements.h"
#include "vicon/report/wording.h"

namespace vicon::report {
namespace {

constexpr std::array<TableColumn, 8> kFindingColumns = {{{"No.", 0},
                                                         {"Finding", 0.05},
                                                         {"Size", 0.32},
                                                         {"Place", 0.405},
                                                         {"From rectum", 0.635},
                                                         {"Endoscope, est.", 0.75},
                                                         {"Scans", 0.88},
                                                         {"Page", 0.94}}};

std::string numberOf(const FindingWithFacts& f)
{
    return std::to_string(f.finding.number());
}

/// "28 - 41 cm".
std::string endoscopeRange(const FindingFacts& facts)
{
    if (!facts.endoscope)
        return "-";
    const auto centimetres = [](double mm) { return std::to_string(std::lround(mm / 10)); };
    return centimetres(facts.endoscope->least_mm) + " - " + centimetres(facts.endoscope->most_mm) + " cm";
}

/// What the table says of it; its page is filled in later.
std::vector<std::string> cellsOf(const FindingWithFacts& f)
{
    const FindingSight* lead = f.facts.lead();
    return {numberOf(f),
            kindWords(f.finding),
            f.facts.size_mm ? sizeWords(f.facts) : "-",
            placeWords(f.facts),
            lead ? millimetres(lead->station_mm) : "-",
            endoscopeRange(f.facts),
            std::to_string(f.facts.sights.size())};
}

}  // namespace

double Sections::findingTableHeight() const
{
    const auto linesOf = [&](const std::string& text, TextStyle style) {
        return text.empty() ? 0.0 : double(flow_.type.lines(text, style, flow_.width()).size()) * leadingOf(style);
    };
    const std::string of_none = unassignedMarkersSentence(content_.read.loose_markers);
    double height = leadingOf(look::kSection) + 8 + look::kGap + linesOf(of_none, look::kBody);
    if (content_.read.findings.empty())
        return height + leadingOf(look::kBody);
    height +=
        (of_none.empty() ? 0 : look::kGap / 2) + RowTable::headHeight() + linesOf(distancesExplained(), look::kSmall);
    const RowTable table(flow_, kFindingColumns);
    for (const FindingWithFacts& f : content_.read.findings)
        height += table.rowHeight(cellsOf(f));
    return height;
}

void Sections::drawFindingTable()
{
    const auto& findings = content_.read.findings;
    drawSection(flow_, "Findings in the colon", 3 * leadingOf(look::kBody));
    const std::string of_none = unassignedMarkersSentence(content_.read.loose_markers);
    if (!of_none.empty())
        flow_.paragraph(flow_.left(), flow_.width(), flow_.type.lines(of_none, look::kBody, flow_.width()), look::kBody,
                        look::kInk);
    if (findings.empty()) {
        if (of_none.empty())
            flow_.paragraph(flow_.left(), flow_.width(), {flow_.type.line(kNoFindings, look::kBody)}, look::kBody,
                            look::kInk);
        flow_.skip(look::kGap);
        return;
    }
    if (!of_none.empty())
        flow_.skip(look::kGap / 2);
    RowTable table(flow_, kFindingColumns);
    table.drawHead();
    for (const FindingWithFacts& f : findings) {
        const std::vector<std::string> cells = cellsOf(f);
        table.beginRow(cells);
        rows_[f.finding.id] = {flow_.page(), table.left(kFindingColumns.size() - 1), flow_.y()};
        table.drawRow(cells);
    }
    flow_.paragraph(flow_.left(), flow_.width(), flow_.type.lines(distancesExplained(), look::kSmall, flow_.width()),
                    look::kSmall, look::kMuted);
    flow_.skip(look::kGap);
}

void Sections::drawFindingHead(const FindingWithFacts& f)
{
    const double x = flow_.left(), height = leadingOf(look::kEntry) + 6;
    flow_.pdf.fill(flow_.page(), {x, flow_.y() - height, flow_.width(), height}, look::kPale);
    const TextLine title = flow_.type.line("Finding " + numberOf(f) + ": " + kindWords(f.finding), look::kEntry);
    flow_.put(x + 6, flow_.y() - 3, title, look::kInk);
    flow_.putRight(x + flow_.width() - 6, flow_.y() - 3, flow_.type.line(sizeWords(f.facts), look::kEntry), look::kInk);
    flow_.skip(height + 4);
}

void Sections::drawFinding(const FindingWithFacts& f)
{
    const StatementTable table(flow_.type, findingStatements(content_.read, f), flow_.width());
    const double head = leadingOf(look::kEntry) + 10;
    const std::vector<PictureBlock> pictures = sightsOf(f);
    double whole = head + table.height() + look::kGap;
    for (const PictureBlock& block : pictures)
        whole += heightOf(block);
    flow_.need(whole <= flow_.wholePage() ? whole : head + 3 * leadingOf(look::kBody));
    fillPageOf(f.finding.id);
    flow_.pdf.bookmark(flow_.page(), flow_.y() + 4, "Finding " + numberOf(f) + " (" + nameOf(f.finding.kind) + ")",
                       true);
    drawFindingHead(f);
    table.draw(flow_, flow_.left());
    flow_.skip(5);
    for (const PictureBlock& block : pictures)
        drawPictures(block);
    flow_.skip(look::kGap / 2);
}

}  // namespace vicon::report
