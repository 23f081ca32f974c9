// The part of Sections that is about markers.
#include <algorithm>
#include <array>

#include "row_table.h"
#include "sections.h"
#include "vicon/report/wording.h"

namespace vicon::report {
namespace {

constexpr double kDiscRadius = 4;

Color inkOf(MarkerColor color)
{
    switch (color) {
        case MarkerColor::red:
            return {0.85F, 0.11F, 0.11F};
        case MarkerColor::yellow:
            return {0.98F, 0.80F, 0.06F};
        case MarkerColor::green:
            return {0.13F, 0.62F, 0.25F};
    }
    return look::kInk;
}

constexpr std::array<TableColumn, 7> kColumns = {{{"Marker", 0.028},
                                                  {"Scan", 0.19},
                                                  {"Segment", 0.42},
                                                  {"From rectum", 0.58},
                                                  {"From caecum", 0.71},
                                                  {"Fraction", 0.84},
                                                  {"Page", 0.94}}};

}  // namespace

std::vector<const MarkerEntry*> Sections::looseMarkers() const
{
    const auto& loose = content_.read.loose_markers;
    std::vector<const MarkerEntry*> out;
    for (const MarkerEntry& entry : content_.markers)
        if (std::find(loose.begin(), loose.end(), entry.marker.id) != loose.end())
            out.push_back(&entry);
    return out;
}

void Sections::drawMarkers()
{
    const std::vector<const MarkerEntry*> markers = looseMarkers();
    if (markers.empty())
        return;
    const auto explained = flow_.type.lines(distancesExplained(), look::kSmall, flow_.width());
    drawSection(flow_, "Markers not assigned to a finding", 8 * leadingOf(look::kBody));
    flow_.paragraph(flow_.left(), flow_.width(), explained, look::kSmall, look::kMuted);
    flow_.skip(look::kGap / 2);
    drawMarkerTable(markers);
    for (const MarkerEntry* entry : markers)
        drawMarker(*entry);
}

void Sections::fillPageOf(const std::string& id)
{
    const auto row = rows_.find(id);
    if (row == rows_.end())
        return;
    const TextLine number = flow_.type.line(std::to_string(flow_.page() + 1), look::kBody);
    const auto& [page, x, y] = row->second;
    flow_.pdf.text(page, x, y - look::kBody.size * look::kAscent, number, look::kInk);
}

void Sections::drawMarkerTable(const std::vector<const MarkerEntry*>& markers)
{
    RowTable table(flow_, kColumns);
    table.drawHead();
    for (const MarkerEntry* entry : markers) {
        const Marker& m = entry->marker;
        const std::vector<std::string> cells{
            m.id + " " + nameOf(m.color),  entry->scan_label,  entry->part_name, millimetres(m.station_mm),
            millimetres(m.from_caecum_mm), percent(m.fraction)};
        table.beginRow(cells);
        flow_.pdf.disc(flow_.page(), flow_.left() + kDiscRadius, flow_.y() - 0.7 * look::kBody.size, kDiscRadius - 0.8,
                       inkOf(m.color));
        rows_[m.id] = {flow_.page(), table.left(kColumns.size() - 1), flow_.y()};
        table.drawRow(cells);
    }
    flow_.skip(look::kGap);
}

void Sections::drawMarkerHead(const MarkerEntry& entry)
{
    const double x = flow_.left(), height = leadingOf(look::kEntry) + 6;
    flow_.pdf.fill(flow_.page(), {x, flow_.y() - height, flow_.width(), height}, look::kPale);
    flow_.pdf.disc(flow_.page(), x + 6 + kDiscRadius, flow_.y() - height / 2, kDiscRadius, inkOf(entry.marker.color));
    const TextLine title =
        flow_.type.line("Marker " + entry.marker.id + ", " + nameOf(entry.marker.color), look::kEntry);
    flow_.put(x + 20, flow_.y() - 3, title, look::kInk);
    const double scan_width = flow_.width() - 20 - title.width - 20;
    flow_.putRight(x + flow_.width() - 6, flow_.y() - 4, cutTo(flow_.type, entry.scan_label, look::kBody, scan_width),
                   look::kMuted);
    flow_.skip(height + 4);
}

void Sections::drawMarker(const MarkerEntry& entry)
{
    const Marker& marker = entry.marker;
    const StatementTable table(flow_.type, markerStatements(entry), flow_.width());
    const double note_width = flow_.width() - look::kLabelWidth;
    const std::vector<TextLine> note =
        marker.note.empty() ? std::vector<TextLine>{} : flow_.type.lines(marker.note, look::kBody, note_width);
    const double leading = leadingOf(look::kBody), head = leadingOf(look::kEntry) + 10;
    const double text = head + table.height() + double(note.size()) * leading + 5;
    const PictureBlock pictures = blockOf({{&entry, entry.scan_label + ", " + marker.id}}, &entry);
    const double whole = text + heightOf(pictures);
    flow_.need(whole <= flow_.wholePage() ? whole : head + table.height() + 3 * leading);

    fillPageOf(marker.id);
    flow_.pdf.bookmark(flow_.page(), flow_.y() + 4, "Marker " + marker.id + " (" + nameOf(marker.color) + ")", true);
    drawMarkerHead(entry);
    table.draw(flow_, flow_.left());
    drawNote(marker, note);
    flow_.skip(5);
    drawPictures(pictures);
}

void Sections::drawNote(const Marker& marker, const std::vector<TextLine>& note)
{
    std::string label = "Note";
    int page = -1;
    for (const TextLine& line : note) {
        flow_.need(leadingOf(look::kBody));
        if (flow_.page() != page)  // a page that begins within a note says whose it is
            flow_.put(flow_.left(), flow_.y(), flow_.type.line(label, look::kBody), look::kMuted);
        page = flow_.page();
        label = "Note of " + marker.id;
        flow_.paragraph(flow_.left() + look::kLabelWidth, flow_.width() - look::kLabelWidth, {line}, look::kBody,
                        look::kInk);
    }
}

}  // namespace vicon::report
