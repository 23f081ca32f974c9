#include "blocks.h"

#include <algorithm>

#include "ready_picture.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon::report {
namespace {

constexpr double kRowGap = 1.5;       ///< between statements, points
constexpr double kNoticePadding = 6;  ///< points
constexpr double kCaptionGap = 3;     ///< points
/// Finer than this a printer does not print, and the file only grows.
constexpr double kPrintDpi = 300;
constexpr double kPointsPerInch = 72;
/// Pictures of few pixels are not blown up further.
constexpr double kMostPointsPerPixel = 1.5;

}  // namespace

StatementTable::StatementTable(Typesetter& type, const std::vector<Statement>& statements, double width,
                               double label_width)
    : label_width_(label_width)
{
    for (const Statement& statement : statements)
        blocks_.push_back(
            {type.line(statement.label, look::kBody), type.lines(statement.text, look::kBody, width - label_width)});
}

double StatementTable::height() const
{
    double height = 0;
    for (const StatementBlock& block : blocks_)
        height += double(block.lines.size()) * leadingOf(look::kBody) + kRowGap;
    return height;
}

void StatementTable::draw(PageFlow& flow, double x) const
{
    for (const StatementBlock& block : blocks_) {
        flow.need(leadingOf(look::kBody));
        flow.put(x, flow.y(), block.label, look::kMuted);
        for (const TextLine& line : block.lines) {
            flow.need(leadingOf(look::kBody));
            flow.put(x + label_width_, flow.y(), line, look::kInk);
            flow.skip(leadingOf(look::kBody));
        }
        flow.skip(kRowGap);
    }
}

void drawSection(PageFlow& flow, const std::string& title, double following)
{
    const double height = leadingOf(look::kSection) + 8;
    flow.need(height + following);
    std::string ascii = title;  // as the outline takes it
    std::erase_if(ascii, [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
    flow.pdf.bookmark(flow.page(), flow.y() + 4, ascii);
    flow.put(flow.left(), flow.y(), flow.type.line(title, look::kSection), look::kAccent);
    flow.skip(leadingOf(look::kSection) + 1);
    flow.pdf.line(flow.page(), flow.left(), flow.y(), flow.left() + flow.width(), flow.y(), look::kThinLine,
                  look::kAccent);
    flow.skip(7);
}

void drawNotice(PageFlow& flow, const std::vector<std::string>& lines)
{
    for (const std::string& text : lines) {
        const auto set = flow.type.lines(text, look::kBold, flow.width() - 2 * kNoticePadding);
        const double height = double(set.size()) * leadingOf(look::kBold) + 2 * kNoticePadding;
        flow.need(height);
        flow.pdf.fill(flow.page(), {flow.left(), flow.y() - height, flow.width(), height}, look::kNoticeFill);
        flow.skip(kNoticePadding);
        flow.paragraph(flow.left() + kNoticePadding, flow.width() - 2 * kNoticePadding, set, look::kBold,
                       look::kNoticeInk);
        flow.skip(kNoticePadding + 4);
    }
}

const PictureShelf::Shelved& PictureShelf::get(const std::filesystem::path& file, double print_width)
{
    static const Shelved nothing;
    if (file.empty())
        return nothing;
    const int most_pixels = int(print_width / kPointsPerInch * kPrintDpi);
    if (const PrintPictures::Ready* ready = begun_ ? begun_->get(file) : nullptr) {
        const std::string key = "begun: " + file.string();
        if (!shelf_.contains(key))
            shelf_[key] = {pdf_.addPicture(*ready), double(ready->width), double(ready->height), false};
        return shelf_[key];
    }
    std::string key = "not readable: " + file.string();
    try {
        key = sha256OfFile(file);
        if (shelf_.contains(key))
            return shelf_[key];
        Picture picture = readForPrint(file, most_pixels);
        const double width = picture.width, height = picture.height;
        return shelf_[key] = {pdf_.addPicture(std::move(picture)), width, height, false};
    } catch (const Error& e) {
        if (e.code() == ErrorCode::no_memory || e.code() == ErrorCode::internal)
            throw;
        return shelf_[key] = {.unreadable = true};
    }
}

Box FramedPicture::fitted(double width, double height) const
{
    if (picture.number < 0)
        return {0, 0, width, height};
    const double scale = std::min({width / picture.width, height / picture.height, kMostPointsPerPixel});
    return {0, 0, picture.width * scale, picture.height * scale};
}

double FramedPicture::draw(PageFlow& flow, double x, double y, double width, double height) const
{
    const Box box = fitted(width, height);
    if (picture.number >= 0) {
        flow.pdf.draw(flow.page(), picture.number, {x, y - box.height, box.width, box.height});
    } else {
        flow.pdf.fill(flow.page(), {x, y - box.height, box.width, box.height}, look::kPale);
        const auto lines = flow.type.lines(absent, look::kBody, box.width - 2 * kNoticePadding);
        double top = y - box.height / 2 + double(lines.size()) * leadingOf(look::kBody) / 2;
        for (const TextLine& line : lines) {
            flow.put(x + (box.width - line.width) / 2, top, line, look::kMuted);
            top -= leadingOf(look::kBody);
        }
    }
    double used = box.height + kCaptionGap;
    for (const TextLine& line : flow.type.lines(caption, look::kSmall, width)) {
        flow.put(x, y - used, line, look::kMuted);
        used += leadingOf(look::kSmall);
    }
    return used;
}

}  // namespace vicon::report
