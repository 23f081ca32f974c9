#include "sections.h"

#include <algorithm>

#include "vicon/report/finding_statements.h"
#include "vicon/report/wording.h"

namespace vicon::report {
namespace {

// Of the map, an overview for each scan: points.
constexpr double kSmallestMap = 120, kTallestMap = 235, kWidestOverview = 246;
constexpr double kTallestQuietMap = 105, kWidestQuietMap = 122, kMapGap = 8;  // where nothing was found
constexpr std::size_t kMapsBeside = 3, kQuietMaps = 2;                        // in a row
constexpr double kColumnGap = 18, kScanLabelWidth = 150;

constexpr const char* kLossyMark = "\nLOSSY COMPRESSION";

}  // namespace

void Sections::draw()
{
    drawTitle();
    drawCase();
    drawImpression();
    if (!drawQuietStudy()) {
        drawMap();
        drawFindingTable();
        // Page one is for who referred the patient; what follows is for who looks closer.
        if (!content_.markers.empty() && flow_.page() == 0)
            flow_.startPage();
        for (const FindingWithFacts& finding : content_.read.findings)
            drawFinding(finding);
        drawMarkers();
        drawStudy();
    }
    drawQuality();
    drawScans();
    drawSignature();
}

void Sections::drawTitle()
{
    flow_.put(flow_.left(), flow_.y(), flow_.type.line("CT colonography report", look::kTitle), look::kAccent);
    flow_.skip(leadingOf(look::kTitle));
    const std::string made = content_.version
                                 ? stateWords(content_.version)
                                 : "Draft " + std::to_string(content_.number) +
                                       " of this study's report, "
                                       "made on " +
                                       utcWords(content_.created) + " with VICON " + content_.software_version;
    flow_.put(flow_.left(), flow_.y(), flow_.type.line(made, look::kBody), look::kMuted);
    flow_.skip(leadingOf(look::kBody) + 10);
    drawNotice(flow_, content_.read.record.flags);
    if (!content_.read.record.flags.empty())
        flow_.skip(look::kGap / 2);
}

void Sections::drawCase()
{
    const double column = (flow_.width() - kColumnGap) / 2;
    const StatementTable patient(flow_.type, patientStatements(content_.read.record), column, look::kNarrowLabelWidth);
    const StatementTable study(flow_.type, studyStatements(content_.read.record), column, look::kNarrowLabelWidth);
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

FramedPicture Sections::overviewOf(const ScanEntry& entry)
{
    return framed(entry.overview_picture, kWidestOverview,
                  scanTitle(entry) + (entry.scan.series.lossy ? kLossyMark : ", from the front"), "overview",
                  "scan " + entry.scan.id);
}

void Sections::drawImpression()
{
    const ReadCase& read = content_.read;
    std::vector<Statement> said{{"Impression", impressionText(read)}};
    for (Statement& statement : categoryStatements(read))
        said.push_back(std::move(statement));
    said.push_back({"Recommended", recommendationText(read)});
    if (const std::string amends = amendmentWords(content_.version); !amends.empty())
        said.push_back({"Amendment", amends});
    const StatementTable table(flow_.type, said, flow_.width());
    drawSection(flow_, "Impression", std::min(table.height(), flow_.wholePage() / 2));
    table.draw(flow_, flow_.left());
    flow_.skip(look::kGap);
}

void Sections::drawMap()
{
    if (content_.scans.empty()) {
        flow_.paragraph(flow_.left(), flow_.width(), {flow_.type.line("This case has no scan.", look::kBody)},
                        look::kBody, look::kInk);
        flow_.skip(look::kGap);
        return;
    }
    const double captions = 2 * leadingOf(look::kSmall) + 8;
    const std::size_t beside = std::min(content_.scans.size(), kMapsBeside);
    const double column = (flow_.width() - double(beside - 1) * kColumnGap) / double(beside);
    for (std::size_t n = 0; n < content_.scans.size(); n += beside) {
        flow_.need(kSmallestMap + captions);
        const double height = std::clamp(flow_.room() - captions, kSmallestMap, kTallestMap);
        double used = 0;
        for (std::size_t k = n; k < std::min(n + beside, content_.scans.size()); ++k)
            used = std::max(used, overviewOf(content_.scans[k])
                                      .draw(flow_, flow_.left() + double(k - n) * (column + kColumnGap), flow_.y(),
                                            column, height));
        flow_.skip(used + look::kGap / 2);
    }
}

bool Sections::drawQuietStudy()
{
    if (!content_.read.findings.empty() || !content_.markers.empty() || !content_.read.loose_markers.empty() ||
        content_.scans.empty() || content_.scans.size() > kQuietMaps)
        return false;
    std::vector<Statement> said{{"In the colon", kNoFindings}};
    for (Statement& statement : extracolonicStatements(content_.read))
        said.push_back({"Outside", (statement.label == "None" ? "" : statement.label + ", ") + statement.text});
    for (Statement& statement : assessmentStatements(content_.read))
        said.push_back(std::move(statement));
    const double column = (flow_.width() - kColumnGap) / 2, maps = double(content_.scans.size());
    const double map_width = std::min((column - (maps - 1) * kMapGap) / maps, kWidestQuietMap);
    const StatementTable table(flow_.type, said, column, look::kNarrowLabelWidth);
    const double captions = 3 * leadingOf(look::kSmall) + 4, heading = leadingOf(look::kSection) + 8;
    if (heading + std::max(table.height(), kSmallestMap + captions) > flow_.room())
        return false;
    drawSection(flow_, "Findings", table.height());
    const double top = flow_.y();
    double used = table.height();
    for (std::size_t n = 0; n < content_.scans.size(); ++n)
        used = std::max(
            used, overviewOf(content_.scans[n])
                      .draw(flow_, flow_.left() + double(n) * (map_width + kMapGap), top, map_width, kTallestQuietMap));
    table.draw(flow_, flow_.left() + column + kColumnGap);
    flow_.skip(used - table.height() + look::kGap / 2);
    return true;
}

void Sections::drawStudy()
{
    const auto drawTable = [&](const char* title, const std::vector<Statement>& statements) {
        const StatementTable table(flow_.type, statements, flow_.width());
        drawSection(flow_, title, std::min(table.height(), flow_.wholePage() / 2));
        table.draw(flow_, flow_.left());
        flow_.skip(look::kGap);
    };
    drawTable("Outside the colon", extracolonicStatements(content_.read));
    drawTable("Study", assessmentStatements(content_.read));
}

void Sections::drawScans()
{
    if (std::all_of(content_.scans.begin(), content_.scans.end(), isPlain) && !content_.scans.empty()) {
        std::vector<Statement> said;
        for (const ScanEntry& entry : content_.scans)
            said.push_back(briefStatement(entry));
        const StatementTable table(flow_.type, said, flow_.width(), kScanLabelWidth);
        drawSection(flow_, "Scans", table.height());
        table.draw(flow_, flow_.left());
        flow_.skip(look::kGap / 2);
        return;
    }
    const double column = (flow_.width() - kColumnGap) / 2, heading = leadingOf(look::kSection) + 8;
    for (std::size_t n = 0; n < content_.scans.size(); n += 2) {
        const std::size_t end = std::min(n + 2, content_.scans.size());
        const double width = end - n == 2 ? column : flow_.width();
        std::vector<StatementTable> tables;
        double height = 0;
        for (std::size_t k = n; k < end; ++k) {
            tables.emplace_back(flow_.type, scanStatements(content_.scans[k]), width, look::kNarrowLabelWidth);
            height = std::max(height, tables.back().height());
        }
        if (heading + height > flow_.wholePage()) {  // more to say than a page holds: below each other
            for (std::size_t k = n; k < end; ++k) {
                drawSection(flow_, scanTitle(content_.scans[k]), 3 * leadingOf(look::kBody));
                StatementTable(flow_.type, scanStatements(content_.scans[k]), flow_.width()).draw(flow_, flow_.left());
                flow_.skip(look::kGap);
            }
            continue;
        }
        flow_.need(heading + height);
        const double top = flow_.y();
        for (std::size_t k = n; k < end; ++k) {
            const double x = flow_.left() + double(k - n) * (column + kColumnGap);
            flow_.put(x, top, flow_.type.line(scanTitle(content_.scans[k]), look::kEntry), look::kAccent);
            const double rule = top - leadingOf(look::kSection);
            flow_.pdf.line(flow_.page(), x, rule, x + width, rule, look::kThinLine, look::kAccent);
            flow_.skip(heading);
            tables[k - n].draw(flow_, x);
            flow_.skip(flow_.y() - top);
        }
        flow_.skip(heading + height + look::kGap);
    }
}

void Sections::drawSignature()
{
    std::vector<TextLine> lines{flow_.type.line(stateWords(content_.version), look::kBold)};
    if (const std::string amends = amendmentWords(content_.version); !amends.empty())
        for (const TextLine& line : flow_.type.lines(amends, look::kBody, flow_.width()))
            lines.push_back(line);
    flow_.need(double(lines.size()) * leadingOf(look::kBold));
    flow_.paragraph(flow_.left(), flow_.width(), lines, look::kBold, look::kInk);
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
