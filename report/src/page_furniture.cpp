#include "page_furniture.h"

#include <algorithm>

#include "page_flow.h"
#include "vicon/cases/printed.h"
#include "vicon/report/finding_statements.h"
#include "vicon/report/statements.h"
#include "vicon/report/wording.h"

namespace vicon::report {
namespace {

constexpr double kTop = 26, kFooter = 24;         ///< from the paper's edge, points
constexpr double kStudyWidth = 150;               ///< of the right column
constexpr double kBandHeight = 17;                ///< of the line that says DRAFT
constexpr double kBelow = 16, kAboveFooter = 14;  ///< between furniture and body
constexpr std::size_t kMostNameLines = 4;         ///< a longer name is whole on the first page

const TextStyle kName{10.5, true};

std::string orNone(const std::string& text, const char* otherwise)
{
    return text.empty() ? otherwise : text;
}

/// At most `most` lines, the last one marked when there were more.
std::vector<TextLine> shortened(std::vector<TextLine> lines, std::size_t most, const TextLine& dots)
{
    if (lines.size() <= most)
        return lines;
    lines.resize(most);
    lines.back().append(dots);
    return lines;
}

double heightOf(const std::vector<TextLine>& lines)
{
    double height = 0;
    for (const TextLine& line : lines)
        height += line.size * look::kLeading;
    return height;
}

}  // namespace

PageFurniture::PageFurniture(const ReportContent& content, Typesetter& type, double page_width)
    : page_width_(page_width), made_by_("Made " + utcWords(content.created) + " with VICON " + content.software_version)
{
    const Patient& patient = content.read.record.patient;
    const double width = page_width - 2 * look::kMargin - kStudyWidth - look::kGap;
    name_ = shortened(type.lines(printedPatientName(patient.name), kName, width), kMostNameLines,
                      type.line(" \u2026", kName));
    const std::string sex = sexWords(patient.sex);
    details_ = type.lines("ID " + orNone(patient.id, "not given") + "  \u00b7  born " +
                              orNone(printedDate(patient.birth_date), "(date not given)") +
                              (sex.empty() ? "" : "  \u00b7  " + sex),
                          look::kBody, width);
    study_ = {
        type.line("Study of " + orNone(printedDate(content.read.record.study.date), "(date not given)"), look::kBold),
        type.line(std::string(examinationOf(quantityOf(content.read))) + " report, " +
                      (content.version ? "version " + std::to_string(content.version->version)
                                       : "draft " + std::to_string(content.number)),
                  look::kBody)};
    if (!content.version)
        draft_ = type.line(kDraftLine, look::kBold);
    else if (!content.version->isSigned())
        draft_ = type.line(kPreliminaryLine, look::kBold);
    else
        made_by_ = stateWords(content.version) + ", with VICON " + content.software_version +
                   ", research software that is no medical device";
}

double PageFurniture::topHeight() const
{
    const double identity = std::max(heightOf(name_) + heightOf(details_), heightOf(study_));
    return kTop + identity + 6 + (draft_.runs.empty() ? 0 : kBandHeight) + kBelow;
}

double PageFurniture::bottomHeight() const
{
    return kFooter + look::kSmall.size * look::kLeading + kAboveFooter;
}

double PageFurniture::drawIdentity(PdfDocument& pdf, int page, double top) const
{
    const auto put = [&](const TextLine& line, double x, double& y, Color color) {
        pdf.text(page, x, y - line.size * look::kAscent, line, color);
        y -= line.size * look::kLeading;
    };
    double left = top, right = top;
    for (const TextLine& line : name_)
        put(line, look::kMargin, left, look::kInk);
    for (const TextLine& line : details_)
        put(line, look::kMargin, left, look::kInk);
    for (const TextLine& line : study_)
        put(line, page_width_ - look::kMargin - line.width, right, look::kInk);
    return std::min(left, right);
}

void PageFurniture::drawFooter(PdfDocument& pdf, Typesetter& type, int page) const
{
    const double top = kFooter + look::kSmall.size * look::kLeading, right = page_width_ - look::kMargin;
    const TextLine number =
        type.line("Page " + std::to_string(page + 1) + " of " + std::to_string(pdf.pages()), look::kSmall);
    pdf.line(page, look::kMargin, top + 4, right, top + 4, look::kThinLine, look::kRule);
    const double baseline = top - look::kSmall.size * look::kAscent;
    pdf.text(page, look::kMargin, baseline, type.line(made_by_, look::kSmall), look::kMuted);
    pdf.text(page, right - number.width, baseline, number, look::kMuted);
}

void PageFurniture::draw(PdfDocument& pdf, Typesetter& type, int page, double page_height) const
{
    const double right = page_width_ - look::kMargin;
    double y = drawIdentity(pdf, page, page_height - kTop) - 6;
    if (draft_.runs.empty()) {
        pdf.line(page, look::kMargin, y, right, y, look::kThinLine, look::kRule);
    } else {
        pdf.fill(page, {look::kMargin, y - kBandHeight, right - look::kMargin, kBandHeight}, look::kDraftFill);
        pdf.text(page, (page_width_ - draft_.width) / 2, y - kBandHeight / 2 - 0.35 * draft_.size, draft_,
                 look::kDraftInk);
    }
    drawFooter(pdf, type, page);
}

}  // namespace vicon::report
