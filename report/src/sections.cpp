#include "sections.h"

#include <algorithm>

#include "vicon/report/wording.h"

namespace vicon::report {
namespace {

constexpr double kOverviewWidth = 196, kOverviewHeight = 240;  ///< points
constexpr double kColumnGap = 18;

std::string lossyMark(bool lossy)
{
    return lossy ? " \u00b7 LOSSY COMPRESSION" : "";
}

}  // namespace

void Sections::draw()
{
    drawTitle();
    drawCase();
    drawScans();
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
}

void Sections::drawCase()
{
    const double column = (flow_.width() - kColumnGap) / 2;
    const StatementTable patient(flow_.type, patientStatements(content_.a_case), column);
    const StatementTable study(flow_.type, studyStatements(content_.a_case), column);
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
    for (const ScanEntry& entry : content_.scans)
        drawScan(entry);
}

void Sections::drawScan(const ScanEntry& entry)
{
    const bool prepared = entry.skeleton_length_mm > 0 || !entry.overview_picture.empty();
    const double column = prepared ? flow_.width() - kOverviewWidth - kColumnGap : flow_.width();
    const StatementTable table(flow_.type, scanStatements(entry), column);
    const FramedPicture overview =
        framed(entry.overview_picture, kOverviewWidth,
               "The whole colon from the front, with its markers" + lossyMark(entry.scan.series.lossy), "overview",
               "scan " + entry.scan.id);
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
