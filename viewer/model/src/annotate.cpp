#include "vicon/viewer/model/annotate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vicon/viewer/model/orientation.h"

namespace vicon::viewer {
namespace {

constexpr double kLineMargin = 0.4, kLineHeight = 1.35;  // of the text's height

OverlayText text(Pixel at, std::string words, double height_px, Rgb color, Across across, Along along)
{
    return {at, std::move(words), height_px, color, across, along};
}

Rgb dimmed(Rgb c, double share)
{
    return {std::uint8_t(c.red * share), std::uint8_t(c.green * share), std::uint8_t(c.blue * share)};
}

// The largest of 1, 2, 5 times a power of ten that is not above `most`.
double roundLength(double most)
{
    const double ten = std::pow(10.0, std::floor(std::log10(most)));
    for (const double factor : {5.0, 2.0})
        if (factor * ten <= most)
            return factor * ten;
    return ten;
}

std::string lengthText(double mm)
{
    const auto plain = [](double v) {
        std::string s = std::to_string(v);
        s.erase(s.find_last_not_of('0') + 1);
        if (s.ends_with('.'))
            s.pop_back();
        return s;
    };
    return mm >= 10 ? plain(mm / 10) + " cm" : plain(mm) + " mm";
}

std::vector<std::string> split(const std::string& s, char at)
{
    std::vector<std::string> parts{""};
    for (const char c : s)
        if (c == at)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

std::size_t characters(const std::string& utf8)
{
    return std::size_t(std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}
}  // namespace

Rgb colorOf(MarkerColor color)
{
    switch (color) {
        case MarkerColor::red:
            return {255, 48, 48};
        case MarkerColor::yellow:
            return {255, 230, 0};
        default:
            return {40, 220, 70};
    }
}

Rgb labelColorOf(MarkerColor color)
{
    constexpr double kWhite = 0.45;
    const auto lighter = [](std::uint8_t c) { return std::uint8_t(std::lround(std::lerp(double(c), 255.0, kWhite))); };
    const Rgb full = colorOf(color);
    return {lighter(full.red), lighter(full.green), lighter(full.blue)};
}

double textHeightFor(int width, int height, double pixel_ratio)
{
    return std::clamp(std::min(width, height) / 38.0, 10.0 * pixel_ratio, 40.0 * pixel_ratio);
}

void addLetters(Overlay& overlay, const Area& area, Vector3 right, Vector3 down, double text_px)
{
    const double margin = text_px * 0.35;
    const Pixel c = area.centre();
    const double big = text_px * 1.25;
    auto& texts = overlay.texts;
    texts.push_back(text({area.x + margin, c.y}, lettersFor(-right), big, kLetterColor, Across::left, Along::middle));
    texts.push_back(
        text({area.right() - margin, c.y}, lettersFor(right), big, kLetterColor, Across::right, Along::middle));
    texts.push_back(text({c.x, area.y + margin}, lettersFor(-down), big, kLetterColor, Across::centre, Along::top));
    texts.push_back(
        text({c.x, area.bottom() - margin}, lettersFor(down), big, kLetterColor, Across::centre, Along::bottom));
}

void addScaleBar(Overlay& overlay, const Area& area, double mm_per_pixel, double text_px)
{
    constexpr double kShare = 0.3, kMostOfHeight = 0.45;  // of a flat picture's width the most would be metres
    const double bar_mm = roundLength(std::min(kShare * area.width, kMostOfHeight * area.height) * mm_per_pixel);
    const double bar_px = bar_mm / mm_per_pixel;
    const Pixel end{area.right() - text_px, area.bottom() - text_px * 0.8};
    const Pixel begin{end.x - bar_px, end.y};
    const double tick = text_px * 0.3;
    overlay.lines.push_back({{{begin.x, begin.y - tick}, begin, end, {end.x, end.y - tick}}, kTextColor, 1.5, 0});
    overlay.texts.push_back(text({(begin.x + end.x) / 2, end.y - tick - 1}, lengthText(bar_mm), text_px, kTextColor,
                                 Across::centre, Along::bottom));
}

void addTriad(Overlay& overlay, Pixel centre, double radius_px, const Pose& pose, double text_px)
{
    constexpr double kAway = 0.3;                               // of a unit vector: drawn dim
    constexpr double kLetterWidth = 1.1, kLetterHeight = 1.35;  // with its ground, of the text's height
    struct Axis {
        Vector3 direction;
        double away;
    };
    std::array<Axis, 6> axes;
    for (int n = 0; n < 6; ++n) {
        const double sign = n % 2 ? -1 : 1;
        const Vector3 d{n / 2 == 0 ? sign : 0, n / 2 == 1 ? sign : 0, n / 2 == 2 ? sign : 0};
        axes[std::size_t(n)] = {d, dot(d, pose.forward)};
    }
    std::stable_sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) { return a.away > b.away; });
    overlay.discs.push_back({centre, radius_px * 1.35, dimmed(kTextColor, 0.5), 1});
    const auto at = [&](const Axis& axis, double share) {
        return Pixel{centre.x + dot(axis.direction, pose.right()) * radius_px * share,
                     centre.y - dot(axis.direction, pose.up) * radius_px * share};
    };
    const auto colorOf = [](const Axis& axis) { return dimmed(kLetterColor, axis.away > kAway ? 0.55 : 1.0); };
    for (const Axis& axis : axes)
        overlay.lines.push_back({{centre, at(axis, 0.72)}, colorOf(axis), axis.away > kAway ? 1.0 : 1.8, 0});
    std::vector<Pixel> written;
    for (auto axis = axes.rbegin(); axis != axes.rend();
         ++axis) {  // the nearest first: what lies behind it is left out
        const Pixel letter = at(*axis, 1);
        const bool free = std::ranges::none_of(written, [&](Pixel other) {
            return std::abs(other.x - letter.x) < kLetterWidth * text_px &&
                   std::abs(other.y - letter.y) < kLetterHeight * text_px;
        });
        if (!free)
            continue;
        written.push_back(letter);
        overlay.texts.push_back(text(letter, std::string{letterFor(axis->direction)}, text_px, colorOf(*axis),
                                     Across::centre, Along::middle));
    }
}

void addLines(Overlay& overlay, const Area& area, const std::vector<OverlayText>& lines, double text_px)
{
    const double margin = kLineMargin * text_px;
    double y = area.y + margin;
    int block = 1;
    for (const OverlayText& other : overlay.texts)
        block = std::max(block, other.block + 1);
    for (OverlayText line : lines) {
        line.at = {area.x + margin, y};
        line.height_px = text_px;
        line.across = Across::left;
        line.along = Along::top;
        line.most_width_px = area.width - 2 * margin;
        line.block = block;
        overlay.texts.push_back(line);
        y += kLineHeight * text_px;
    }
}

std::vector<OverlayText> broken(const std::vector<OverlayText>& lines, double width_px, double text_px,
                                std::size_t most)
{
    constexpr double kLetter = 0.55;  // width of a usual letter in heights of the text
    std::vector<OverlayText> all;
    for (OverlayText line : lines)
        for (const std::string& words : wrapped(line.text, std::size_t(width_px / (kLetter * text_px)), most)) {
            line.text = words;
            all.push_back(line);
        }
    return all;
}

Area captionArea(double width_px, double height_px, double text_px, double longest_line)
{
    constexpr double kLetter = 1.6, kBeside = 0.47;  // of the text's height, and of the width
    if (width_px * kBeside < (longest_line + 2 * kLineMargin) * text_px)
        return {0, kLetter * text_px, width_px, height_px - kLetter * text_px};
    return {0, 0, width_px * kBeside, height_px};
}

double heightOfText(std::size_t lines, double height_px)
{
    return height_px / (kLineHeight * double(lines) + 2 * kLineMargin);
}

int linesIn(double height_px, double text_px)
{
    return std::max(1, int((height_px - 2 * kLineMargin * text_px) / (kLineHeight * text_px)));
}

void leaveOut(std::vector<OverlayText>& lines, int most)
{
    for (std::size_t n = lines.size(); n > 0 && int(lines.size()) > std::max(1, most); --n)
        if (lines[n - 1].color == kTextColor)
            lines.erase(lines.begin() + std::ptrdiff_t(n - 1));
}

void addMarkerRing(Overlay& overlay, Pixel at, double radius_px, const Marker& marker, double text_px)
{
    overlay.discs.push_back({at, radius_px, colorOf(marker.color), 2});
    overlay.texts.push_back(text({at.x + radius_px * 0.75 + 2, at.y - radius_px * 0.75 - 1}, marker.id, text_px,
                                 labelColorOf(marker.color), Across::left, Along::bottom));
}

void addCrosshair(Overlay& overlay, const Area& area, Pixel at, double gap_px)
{
    const auto line = [&](Pixel a, Pixel b) { overlay.lines.push_back({{a, b}, kCrosshairColor, 1, 0}); };
    if (at.y >= area.y && at.y <= area.bottom()) {
        line({area.x, at.y}, {std::max(area.x, at.x - gap_px), at.y});
        line({std::min(area.right(), at.x + gap_px), at.y}, {area.right(), at.y});
    }
    if (at.x >= area.x && at.x <= area.right()) {
        line({at.x, area.y}, {at.x, std::max(area.y, at.y - gap_px)});
        line({at.x, std::min(area.bottom(), at.y + gap_px)}, {at.x, area.bottom()});
    }
}

void addSkeleton(Overlay& overlay, const Skeleton& skeleton, const PlaneView& view, double width_px)
{
    for (const SkeletonPiece& piece : skeleton.pieces) {
        OverlayLine line{{}, piece.bridge ? kBridgeColor : kPathColor, width_px, piece.bridge ? 4 * width_px : 0};
        for (const SkeletonPoint& p : piece.points)
            line.points.push_back(view.toPixel(p.position_mm));
        overlay.lines.push_back(std::move(line));
    }
}

void addHere(Overlay& overlay, const PlaneView& view, const Pose& pose, double size_px)
{
    const Pixel at = view.toPixel(pose.eye_mm);
    const double x = dot(pose.forward, view.right), y = dot(pose.forward, view.down);
    const double share = std::hypot(x, y);
    overlay.discs.push_back({at, size_px * 0.45, kHereColor, 2});
    if (share < 0.2)
        return;
    const double ux = x / share, uy = y / share, reach = size_px * (0.8 + 1.6 * share), half = size_px * 0.5;
    const Pixel tip{at.x + ux * reach, at.y + uy * reach};
    const Pixel neck{tip.x - ux * size_px * 0.8, tip.y - uy * size_px * 0.8};
    overlay.lines.push_back({{{at.x + ux * size_px * 0.45, at.y + uy * size_px * 0.45}, tip}, kHereColor, 2, 0});
    overlay.lines.push_back(
        {{{neck.x - uy * half, neck.y + ux * half}, tip, {neck.x + uy * half, neck.y - ux * half}}, kHereColor, 2, 0});
}

std::array<std::string, 2> stationTexts(double station_mm, double length_mm, const OrganWords& words)
{
    const auto whole = [](double mm) { return std::to_string(std::lround(mm)); };
    const double share = length_mm > 0 ? 100 * station_mm / length_mm : 0;
    return {whole(station_mm) + " mm from the " + words.first_end + " (" + whole(share) + " %)",
            whole(length_mm - station_mm) + " mm from the " + words.last_end};
}

std::vector<std::string> wrapped(const std::string& text, std::size_t most, std::size_t lines)
{
    std::vector<std::string> out{""};
    for (const std::string& word : split(text, ' ')) {
        if (word.empty())
            continue;
        if (!out.back().empty() && characters(out.back()) + 1 + characters(word) > most) {
            if (out.size() == lines) {
                out.back() += "…";
                return out;
            }
            out.emplace_back();
        }
        out.back() += (out.back().empty() ? "" : " ") + word;
    }
    return out;
}

}  // namespace vicon::viewer
