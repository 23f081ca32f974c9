#include "pdf_document.h"

#include <hpdf.h>
#include <unicode/unistr.h>

#include <array>
#include <cstdio>
#include <map>

#include "pdf_objects.h"
#include "vicon/core/error.h"

namespace vicon::report {
namespace {

constexpr float kDiscRim = 0.6F;  ///< points
constexpr Color kRimColor{0.25F, 0.25F, 0.25F};

/// libharu calls this on every failure; exceptions must not pass through its C code, so the first one is kept.
struct Failure {
    HPDF_STATUS code = HPDF_OK;
    HPDF_STATUS detail = 0;
};
void keepFailure(HPDF_STATUS code, HPDF_STATUS detail, void* data)
{
    auto* failure = static_cast<Failure*>(data);
    if (failure->code == HPDF_OK)
        *failure = {code, detail};
}

void setInfo(HPDF_Doc document, const PdfInfo& info)
{
    HPDF_SetInfoAttr(document, HPDF_INFO_TITLE, info.title.c_str());
    HPDF_SetInfoAttr(document, HPDF_INFO_CREATOR, info.creator.c_str());
    HPDF_Date date{};
    if (std::sscanf(info.created_utc.c_str(), "%4d-%2d-%2dT%2d:%2d:%2dZ", &date.year, &date.month, &date.day,
                    &date.hour, &date.minutes, &date.seconds) == 6) {
        date.ind = 'Z';
        HPDF_SetInfoDateAttr(document, HPDF_INFO_CREATION_DATE, date);
    }
}

std::string toUtf8(const std::u16string& text)
{
    std::string out;
    icu::UnicodeString(text.data(), std::int32_t(text.size())).toUTF8String(out);
    return out;
}

}  // namespace

struct PdfDocument::State {
    explicit State(const FontSet& font_set) : fonts(font_set), document(HPDF_New(&keepFailure, &failure))
    {
        if (!document)
            throw Error(ErrorCode::no_memory, "a PDF cannot be started");
    }
    ~State() { HPDF_Free(document); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    struct UsedFont {
        HPDF_Font font = nullptr;
        std::set<char16_t> codes;
    };

    void check() const
    {
        if (failure.code == HPDF_OK)
            return;
        if (failure.code == HPDF_FAILD_TO_ALLOC_MEM)
            throw Error(ErrorCode::no_memory, "there is not enough memory for the report");
        std::array<char, 64> what{};
        std::snprintf(what.data(), what.size(), "libharu failed with %04lX (%lu)", failure.code, failure.detail);
        throw Error(ErrorCode::internal, what.data());
    }

    UsedFont& load(int font)
    {
        UsedFont& used = loaded[font];
        if (!used.font) {
            const std::string file = fonts.file(font).string();
            const char* name = file.ends_with(".ttc") ? HPDF_LoadTTFontFromFile2(document, file.c_str(), 0, HPDF_TRUE)
                                                      : HPDF_LoadTTFontFromFile(document, file.c_str(), HPDF_TRUE);
            check();
            used.font = HPDF_GetFont(document, name, "UTF-8");
            check();
        }
        return used;
    }

    HPDF_Page page(int number) const { return page_list.at(std::size_t(number)); }

    Failure failure;
    const FontSet& fonts;
    HPDF_Doc document;
    std::vector<HPDF_Page> page_list;
    std::vector<HPDF_Image> pictures;
    std::map<int, UsedFont> loaded;
};

PdfDocument::PdfDocument(const FontSet& fonts, const PdfInfo& info) : state_(std::make_unique<State>(fonts))
{
    HPDF_SetCompressionMode(state_->document, HPDF_COMP_ALL);
    HPDF_UseUTFEncodings(state_->document);
    setInfo(state_->document, info);
    state_->check();
}

PdfDocument::~PdfDocument() = default;

int PdfDocument::addPage(double width, double height)
{
    HPDF_Page page = HPDF_AddPage(state_->document);
    state_->check();
    HPDF_Page_SetWidth(page, float(width));
    HPDF_Page_SetHeight(page, float(height));
    state_->check();
    state_->page_list.push_back(page);
    return pages() - 1;
}

int PdfDocument::pages() const
{
    return int(state_->page_list.size());
}

void PdfDocument::text(int page, double x, double y, const TextLine& line, Color color)
{
    HPDF_Page target = state_->page(page);
    HPDF_Page_SetRGBFill(target, color.red, color.green, color.blue);
    for (const TextRun& run : line.runs) {
        State::UsedFont& used = state_->load(run.font);
        for (const char16_t code : run.codes)
            if (used.codes.insert(code).second)
                embedGlyphs(used.font, state_->fonts.components(run.font, code));
        HPDF_Page_SetFontAndSize(target, used.font, float(line.size));
        HPDF_Page_BeginText(target);
        HPDF_Page_TextOut(target, float(x + run.x), float(y), toUtf8(run.codes).c_str());
        HPDF_Page_EndText(target);
    }
    state_->check();
}

void PdfDocument::fill(int page, Box box, Color color)
{
    HPDF_Page target = state_->page(page);
    HPDF_Page_SetRGBFill(target, color.red, color.green, color.blue);
    HPDF_Page_Rectangle(target, float(box.x), float(box.y), float(box.width), float(box.height));
    HPDF_Page_Fill(target);
    state_->check();
}

void PdfDocument::line(int page, double x0, double y0, double x1, double y1, double width, Color color)
{
    HPDF_Page target = state_->page(page);
    HPDF_Page_SetRGBStroke(target, color.red, color.green, color.blue);
    HPDF_Page_SetLineWidth(target, float(width));
    HPDF_Page_MoveTo(target, float(x0), float(y0));
    HPDF_Page_LineTo(target, float(x1), float(y1));
    HPDF_Page_Stroke(target);
    state_->check();
}

void PdfDocument::disc(int page, double x, double y, double radius, Color color)
{
    HPDF_Page target = state_->page(page);
    HPDF_Page_SetRGBFill(target, color.red, color.green, color.blue);
    HPDF_Page_SetRGBStroke(target, kRimColor.red, kRimColor.green, kRimColor.blue);
    HPDF_Page_SetLineWidth(target, kDiscRim);
    HPDF_Page_Circle(target, float(x), float(y), float(radius));
    HPDF_Page_FillStroke(target);
    state_->check();
}

int PdfDocument::addPicture(const Picture& picture)
{
    state_->pictures.push_back(embedPicture(state_->document, picture));
    state_->check();
    return int(state_->pictures.size()) - 1;
}

void PdfDocument::draw(int page, int picture, Box box)
{
    HPDF_Page_DrawImage(state_->page(page), state_->pictures.at(std::size_t(picture)), float(box.x), float(box.y),
                        float(box.width), float(box.height));
    state_->check();
}

void PdfDocument::bookmark(int page, double y, const std::string& title)
{
    HPDF_Outline entry = HPDF_CreateOutline(state_->document, nullptr, title.c_str(), nullptr);
    HPDF_Destination target = HPDF_Page_CreateDestination(state_->page(page));
    state_->check();
    HPDF_Destination_SetFitH(target, float(y));
    HPDF_Outline_SetDestination(entry, target);
    state_->check();
}

std::string PdfDocument::finish()
{
    for (auto& [number, used] : state_->loaded)
        setToUnicode(used.font, used.codes);
    HPDF_SaveToStream(state_->document);
    state_->check();
    std::string bytes(HPDF_GetStreamSize(state_->document), '\0');
    HPDF_ResetStream(state_->document);
    std::size_t read = 0;
    while (read < bytes.size()) {
        auto size = HPDF_UINT32(bytes.size() - read);
        HPDF_ReadFromStream(state_->document, reinterpret_cast<HPDF_BYTE*>(bytes.data()) + read, &size);
        if (size == 0)
            break;
        read += size;
    }
    if (read != bytes.size())
        throw Error(ErrorCode::internal, "libharu did not give the whole PDF");
    return bytes;
}

}  // namespace vicon::report
