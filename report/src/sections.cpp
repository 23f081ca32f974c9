#include "sections.h"

#include <algorithm>

#include "vicon/report/finding_statements.h"
#include "vicon/report/wording.h"

namespace vicon::report {
namespace {

constexpr double kScanLabelWidth = 150;

}  // namespace

void Sections::draw()
{
    drawTitle();
    drawCase();
    drawImpression();
    bool study_told = drawMapBesideFacts();
    if (!study_told)
        drawMap();
    if (!study_told || !isQuiet())
        drawFindingTable();
    drawComparison();
    if (!study_told && studyHeight() <= flow_.room() && flow_.page() == 0) {
        drawStudy();
        study_told = true;
    }
    if (!isQuiet() && flow_.page() == 0)
        drawQualityOnPageOne();
    // Page one is for who referred the patient; what follows is for who looks closer.
    if (!content_.markers.empty() && flow_.page() == 0)
        flow_.startPage();
    if (!content_.read.findings.empty())
        flow_.pdf.bookmark(flow_.page(), flow_.y() + 4, "Findings, one by one");
    for (const FindingWithFacts& finding : content_.read.findings)
        drawFinding(finding);
    drawMarkers();
    if (!study_told)
        drawStudy();
    drawQuality();
    if (!scansToldInStrips())
        drawScans();
    drawSignature();
}

bool Sections::isQuiet() const
{
    return content_.read.findings.empty() && content_.markers.empty() && content_.read.loose_markers.empty();
}

double Sections::studyHeight() const
{
    const double heading = leadingOf(look::kSection) + 8;
    return 2 * (heading + look::kGap) +
           StatementTable(flow_.type, extracolonicStatements(content_.read), flow_.width()).height() +
           StatementTable(flow_.type, examinationStatements(), flow_.width()).height();
}

std::vector<Statement> Sections::examinationStatements() const
{
    std::vector<Statement> said = reliabilityStatements(content_.read);
    for (Statement& statement : techniqueStatements(content_.read))
        said.push_back(std::move(statement));
    return said;
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
    drawTable("Examination", examinationStatements());
}

std::vector<Statement> Sections::briefScans() const
{
    std::vector<Statement> said;
    if (std::all_of(content_.scans.begin(), content_.scans.end(), isPlain))
        for (const ScanEntry& entry : content_.scans)
            said.push_back(briefStatement(entry));
    return said;
}

double Sections::briefScansHeight() const
{
    const std::vector<Statement> said = briefScans();
    return said.empty() ? 0
                        : leadingOf(look::kSection) + 8 + look::kGap / 2 +
                              StatementTable(flow_.type, said, flow_.width(), kScanLabelWidth).height();
}

void Sections::drawScans()
{
    if (const std::vector<Statement> said = briefScans(); !said.empty()) {
        const StatementTable table(flow_.type, said, flow_.width(), kScanLabelWidth);
        drawSection(flow_, "Scans", table.height() + look::kGap / 2 + signatureHeight());
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
        const double last = end == content_.scans.size() ? look::kGap + signatureHeight() : 0;
        flow_.need(heading + height + last);
        const double top = flow_.y();
        if (n == 0)
            flow_.pdf.bookmark(flow_.page(), top + 4, "Scans");
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

std::vector<TextLine> Sections::signatureLines() const
{
    std::vector<TextLine> lines{flow_.type.line(stateWords(content_.version), look::kBold)};
    if (const std::string amends = amendmentWords(content_.version); !amends.empty())
        for (const TextLine& line : flow_.type.lines(amends, look::kBody, flow_.width()))
            lines.push_back(line);
    return lines;
}

double Sections::signatureHeight() const
{
    return double(signatureLines().size()) * leadingOf(look::kBold);
}

void Sections::drawSignature()
{
    flow_.need(signatureHeight());
    flow_.paragraph(flow_.left(), flow_.width(), signatureLines(), look::kBold, look::kInk);
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
        const std::string warning = of + ": the " + kind + " picture cannot be read";
        if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
            warnings_.push_back(warning);
    } else {
        out.absent = "No " + kind + " picture was made.";
    }
    return out;
}

}  // namespace vicon::report
