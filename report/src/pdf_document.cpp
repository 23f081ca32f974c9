#include "pdf_document.h"

#include <cstdio>
#include <future>

#include "haru.h"
#include "pdf_objects.h"
#include "pdf_text.h"
#include "ready_picture.h"
#include "vicon/core/error.h"

namespace vicon::report {
namespace {

constexpr float kDiscRim = 0.6F;  ///< points
constexpr Color kRimColor{0.25F, 0.25F, 0.25F};

void setInfo(HPDF_Doc document, const PdfInfo& info)
{
    HPDF_SetInfoAttr(document, HPDF_INFO_TITLE, info.title.c_str());
    HPDF_SetInfoAttr(document, HPDF_INFO_SUBJECT, info.subject.c_str());
    HPDF_SetInfoAttr(document, HPDF_INFO_CREATOR, info.creator.c_str());
    HPDF_Date date{};
    if (std::sscanf(info.created_utc.c_str(), "%4d-%2d-%2dT%2d:%2d:%2dZ", &date.year, &date.month, &date.day,
                    &date.hour, &date.minutes, &date.seconds) == 6) {
        date.ind = 'Z';
        HPDF_SetInfoDateAttr(document, HPDF_INFO_CREATION_DATE, date);
    }
}

}  // namespace

struct PdfDocument::State {
    explicit State(text::FontSet& fonts) : text(haru, fonts) {}

    HPDF_Page page(int number) const { return pages.at(std::size_t(number)); }
    void check() const { haru.check(); }

    Haru haru;
    PdfText text;
    std::vector<HPDF_Page> pages;
    std::vector<HPDF_Image> pictures;
    HPDF_Outline section = nullptr;                               ///< the last one below none
    std::vector<std::future<std::vector<std::uint8_t>>> streams;  ///< of the pictures, packed while pages are drawn
};

PdfDocument::PdfDocument(text::FontSet& fonts, const PdfInfo& info) : state_(std::make_unique<State>(fonts))
{
    HPDF_Doc document = state_->haru.document();
    HPDF_SetCompressionMode(document, HPDF_COMP_ALL);
    HPDF_UseUTFEncodings(document);
    setInfo(document, info);
    state_->check();
}

PdfDocument::~PdfDocument() = default;

int PdfDocument::addPage(double width, double height)
{
    HPDF_Page page = HPDF_AddPage(state_->haru.document());
    state_->check();
    HPDF_Page_SetWidth(page, float(width));
    HPDF_Page_SetHeight(page, float(height));
    state_->check();
    state_->pages.push_back(page);
    return pages() - 1;
}

int PdfDocument::pages() const
{
    return int(state_->pages.size());
}

void PdfDocument::text(int page, double x, double y, const TextLine& line, Color color)
{
    HPDF_Page target = state_->page(page);
    HPDF_Page_SetRGBFill(target, color.red, color.green, color.blue);
    state_->text.write(target, x, y, line);
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

void PdfDocument::polygon(int page, const std::vector<Corner>& corners, Color color)
{
    if (corners.empty())
        return;
    HPDF_Page target = state_->page(page);
    HPDF_Page_SetRGBFill(target, color.red, color.green, color.blue);
    HPDF_Page_MoveTo(target, float(corners.front().x), float(corners.front().y));
    for (const Corner& corner : corners)
        HPDF_Page_LineTo(target, float(corner.x), float(corner.y));
    HPDF_Page_Fill(target);
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

int PdfDocument::addPicture(Picture picture)
{
    state_->pictures.push_back(addImage(state_->haru.document(), picture.width, picture.height, picture.channels));
    state_->check();
    state_->streams.push_back(
        std::async(std::launch::async, [picture = std::move(picture)] { return packed(picture); }));
    return int(state_->pictures.size()) - 1;
}

int PdfDocument::addPicture(const PrintPictures::Ready& picture)
{
    state_->pictures.push_back(addImage(state_->haru.document(), picture.width, picture.height, picture.channels));
    state_->check();
    std::promise<std::vector<std::uint8_t>> packed;
    packed.set_value(picture.stream);
    state_->streams.push_back(packed.get_future());
    return int(state_->pictures.size()) - 1;
}

void PdfDocument::draw(int page, int picture, Box box)
{
    HPDF_Page_DrawImage(state_->page(page), state_->pictures.at(std::size_t(picture)), float(box.x), float(box.y),
                        float(box.width), float(box.height));
    state_->check();
}

void PdfDocument::bookmark(int page, double y, const std::string& title, bool below)
{
    HPDF_Outline entry =
        HPDF_CreateOutline(state_->haru.document(), below ? state_->section : nullptr, title.c_str(), nullptr);
    if (!below)
        state_->section = entry;
    HPDF_Destination target = HPDF_Page_CreateDestination(state_->page(page));
    state_->check();
    HPDF_Destination_SetFitH(target, float(y));
    HPDF_Outline_SetDestination(entry, target);
    state_->check();
}

std::string PdfDocument::finish()
{
    HPDF_Doc document = state_->haru.document();
    state_->text.finish();
    for (std::size_t n = 0; n < state_->pictures.size(); ++n)
        setPacked(state_->pictures[n], state_->streams[n].get());
    state_->check();
    HPDF_SaveToStream(document);
    state_->check();
    std::string bytes(HPDF_GetStreamSize(document), '\0');
    HPDF_ResetStream(document);
    std::size_t read = 0;
    while (read < bytes.size()) {
        auto size = HPDF_UINT32(bytes.size() - read);
        HPDF_ReadFromStream(document, reinterpret_cast<HPDF_BYTE*>(bytes.data()) + read, &size);
        if (size == 0)
            break;
        read += size;
    }
    if (read != bytes.size())
        throw Error(ErrorCode::internal, "libharu did not give the whole PDF");
    return bytes;
}

}  // namespace vicon::report
