#include "vicon/report/pdf_writer.h"

#include <array>
#include <cstdio>

#include "page_furniture.h"
#include "sections.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon::report {
namespace {

/// Width and height in points.
PageFlow::Paper paperOf(Paper paper)
{
    constexpr double kA4Width = 595.28, kA4Height = 841.89, kLetterWidth = 612, kLetterHeight = 792;
    if (paper == Paper::letter)
        return {.width = kLetterWidth, .height = kLetterHeight};
    return {.width = kA4Width, .height = kA4Height};
}

/// What the file says of itself; nothing of the patient.
std::string subjectOf(const std::optional<ReportVersion>& version)
{
    return version ? nameOf(version->state) + ", version " + std::to_string(version->version) : "draft";
}

std::string missingWords(char32_t c)
{
    if (c == Typesetter::kInvalidUtf8)
        return "a text holds bytes that are no UTF-8; they are printed as [U+FFFD]";
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "no font can show U+%04X; it is printed as [U+%04X]", unsigned(c),
                  unsigned(c));
    return text.data();
}

}  // namespace

PdfResult drawPdf(const ReportContent& content, std::string& pdf, const ReportOptions& options,
                  const PrintPictures* begun, const Progress& wanted)
{
    text::FontSet fonts({options.font_folder}, text::FontSet::Medium::paper);
    if (!fonts.find(U'A'))
        throw Error(ErrorCode::not_found, "no font for the report is installed here", options.font_folder,
                    "install the packages fonts-noto-core and fonts-dejavu-core, or set report.font_folder");
    Typesetter typesetter(fonts);
    PdfDocument document(fonts, {std::string(examinationOf(quantityOf(content.read))) + " report",
                                 subjectOf(content.version), "VICON " + content.software_version, content.created});
    PageFlow::Paper paper = paperOf(options.paper);
    const PageFurniture furniture(content, typesetter, paper.width);
    paper.top = furniture.topHeight();
    paper.bottom = furniture.bottomHeight();
    PageFlow flow(document, typesetter, paper, wanted);
    Sections sections(content, {options.site, options.logo}, flow, begun);
    sections.draw();
    for (int page = 0; page < document.pages(); ++page)
        furniture.draw(document, typesetter, page, paper.height);

    PdfResult result{.warnings = sections.warnings(),
                     .unreadable_pictures = int(sections.warnings().size()),
                     .pages = document.pages()};
    for (const char32_t c : typesetter.missing())
        result.warnings.push_back(missingWords(c));
    wanted.check();
    pdf = document.finish();
    return result;
}

PdfResult writePdf(const ReportContent& content, const std::filesystem::path& pdf, const ReportOptions& options,
                   const PrintPictures* begun)
{
    std::string bytes;
    PdfResult result = drawPdf(content, bytes, options, begun, NoProgress());
    replaceFile(pdf, bytes);
    return result;
}

}  // namespace vicon::report
