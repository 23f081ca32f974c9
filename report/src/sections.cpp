#include "sections.h"

#include <algorithm>
#include <array>

#include "vicon/report/wording.h"

namespace vicon::report {
namespace {

// Of overviews, in points: beside a scan's text, and below it where two scans stand side by side.
constexpr double kOverviewWidth = 216, kOverviewHeight = 264;
constexpr double kSmallestOverview = 170, kTallestOverview = 300, kWidestOverview = 246;
constexpr double kColumnGap = 18;

std::string lossyMark(bool lossy)
{
    return lossy ? " \u00b7 LOSSY COMPRESSION" : "";
}

bool wasPrepared(const ScanEntry& entry)
{
    return entry.skeleton_length_mm > 0 || !entry.overview_picture.empty();
}

}  // namespace

void Sections::draw()
{
    drawTitle();
    drawCase();
    drawScans();
    drawQuality();
    drawMarkers();
}

void Sections::drawTitle()
{
    flow_.put(flow_.left(), flow_.y(), flow_.type.line("CT colonography report", look::kTitle), look::kAccent);
    flow_.skip(leadingOf(look::kTitle));
    const std::string made = "Report " + std::to_string(content_.number) + " of this study, made on " +
                             utcWords(content_.created) + " with VICON " + content_.software_version;
    flow_.put(flow_.left(), flow_.y(), flow_.type.line(made, look::kBody), look::kMuted);
    flow_.skip(leadingOf(look::kBody) + 10);
    drawNotice(flow_, content_.a_case.flags);
    if (!content_.a_case.flags.empty())
        flow_.skip(look::kGap / 2);
}

void Sections::drawCase()
{
    const double column = (flow_.width() - kColumnGap) / 2;
    const StatementTable patient(flow_.type, patientStatements(content_.a_case), column, look::kNarrowLabelWidth);
    const StatementTable study(flow_.type, studyStatements(content_.a_case), column, look::kNarrowLabelWidth);
    const double heading = leadingOf(look::kEntry) + 2;
    const double height = heading + std::max(patient.height(), study.height());
    if (height > flow_.wholePage()) {  // texts of several pages: below each other
        patient.draw(flow_, flow_.left());
        study.draw(flow_, flow_.left());
        return;
    }
    flow_.need(height);
    const auto drawColumn = [&](const char* title, const StatementTable& table, double x) {
        flow_.put(x, flow_.y(), flow_.type.line(title, look::kEntry), look::kInk);
        flow_.skip(heading);
        table.draw(flow_, x);
        flow_.skip(-heading - table.height());
    };
    drawColumn("Patient", patient, flow_.left());
    drawColumn("Study", study, flow_.left() + column + kColumnGap);
    flow_.skip(height + look::kGap);
}

void Sections::drawScans()
{
    if (content_.scans.empty()) {
        drawSection(flow_, "Scans", leadingOf(look::kBody));
        flow_.paragraph(flow_.left(), flow_.width(), {flow_.type.line("This case has no scan.", look::kBody)},
                        look::kBody, look::kInk);
        flow_.skip(look::kGap);
    }
    if (content_.scans.size() == 2 && drawScanPair(content_.scans[0], content_.scans[1]))
        return;
    for (const ScanEntry& entry : content_.scans)
        drawScan(entry);
}

FramedPicture Sections::overviewOf(const ScanEntry& entry)
{
    return framed(entry.overview_picture, kWidestOverview,
                  "The whole colon from the front" + lossyMark(entry.scan.series.lossy), "overview",
                  "scan " + entry.scan.id);
}

bool Sections::drawScanPair(const ScanEntry& first, const ScanEntry& second)
{
    const double column = (flow_.width() - kColumnGap) / 2, top = flow_.y();
    const std::array<const ScanEntry*, 2> entries = {&first, &second};
    std::vector<StatementTable> tables;
    double text_height = 0;
    for (const ScanEntry* entry : entries) {
        tables.emplace_back(flow_.type, scanStatements(*entry), column, look::kNarrowLabelWidth);
        text_height = std::max(text_height, tables.back().height());
    }
    const bool pictures = wasPrepared(first) || wasPrepared(second);
    const double heading = leadingOf(look::kSection) + 8, captions = 2 * leadingOf(look::kSmall) + 8;
    const double picture_height =
        pictures ? std::min(flow_.room() - heading - text_height - captions, kTallestOverview) : 0;
    if (heading + text_height > flow_.room() || (pictures && picture_height < kSmallestOverview))
        return false;
    double used = 0;
    for (std::size_t n = 0; n < entries.size(); ++n) {
        const double x = flow_.left() + double(n) * (column + kColumnGap);
        flow_.put(x, top, flow_.type.line(scanTitle(*entries[n]), look::kEntry), look::kAccent);
        const double rule = top - leadingOf(look::kSection);
        flow_.pdf.line(flow_.page(), x, rule, x + column, rule, look::kThinLine, look::kAccent);
        flow_.skip(heading);
        tables[n].draw(flow_, x);
        flow_.skip(flow_.y() - top);
        if (pictures)
            used = std::max(
                used, overviewOf(*entries[n]).draw(flow_, x, top - heading - text_height - 8, column, picture_height));
    }
    flow_.skip(heading + text_height + 8 + used + look::kGap);
    return true;
}

void Sections::drawScan(const ScanEntry& entry)
{
    const bool prepared = wasPrepared(entry);
    const double column = prepared ? flow_.width() - kOverviewWidth - kColumnGap : flow_.width();
    const StatementTable table(flow_.type, scanStatements(entry), column);
    const FramedPicture overview = prepared ? overviewOf(entry) : FramedPicture{};
    const double picture_height =
        prepared ? overview.fitted(kOverviewWidth, kOverviewHeight).height + 2 * leadingOf(look::kSmall) : 0;
    const double height = std::max(table.height(), picture_height);
    drawSection(flow_, scanTitle(entry), std::min(height, flow_.wholePage() * 0.8));
    if (height > flow_.room()) {  // more to say than a page holds beside the picture
        if (prepared)
            flow_.skip(overview.draw(flow_, flow_.left(), flow_.y(), kOverviewWidth, kOverviewHeight) + look::kGap);
        table.draw(flow_, flow_.left());
    } else {
        if (prepared)
            overview.draw(flow_, flow_.left() + column + kColumnGap, flow_.y(), kOverviewWidth, kOverviewHeight);
        table.draw(flow_, flow_.left());
        flow_.skip(height - table.height());
    }
    flow_.skip(look::kGap);
}

FramedPicture Sections::framed(const std::filesystem::path& file, double print_width, const std::string& caption,
                               const std::string& kind, const std::string& of)
{
    FramedPicture out{shelf_.get(file, print_width), caption, {}};
    if (out.picture.number >= 0)
        return out;
    out.caption.clear();
    if (out.picture.unreadable) {
        out.absent = "The " + kind + " picture cannot be read.";
        warnings_.push_back(of + ": the " + kind + " picture cannot be read");
    } else {
        out.absent = "No " + kind + " picture was made.";
    }
    return out;
}

}  // namespace vicon::report
