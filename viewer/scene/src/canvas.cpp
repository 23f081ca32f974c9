#include "vicon/viewer/scene/canvas.h"

#include <algorithm>
#include <cmath>

#include "mask.h"
#include "text.h"
#include "vicon/picture/png_file.h"

namespace vicon::viewer {
namespace {

constexpr double kRim_px = 1.0;
constexpr double kRimStrength = 0.6;
constexpr Rgb kRimColor{0, 0, 0};

// Cuts a line into dashes as long as the gaps between them.
std::vector<std::vector<Pixel>> dashesOf(const OverlayLine& line)
{
    if (line.dash_px <= 0)
        return {line.points};
    std::vector<std::vector<Pixel>> dashes;
    double done = 0;
    for (std::size_t n = 0; n + 1 < line.points.size(); ++n) {
        const Pixel a = line.points[n], b = line.points[n + 1];
        const double whole = std::hypot(b.x - a.x, b.y - a.y);
        for (double at = 0; at < whole;) {
            const double in_period = std::fmod(done + at, 2 * line.dash_px);
            const bool drawn = in_period < line.dash_px;
            const double rest = (drawn ? line.dash_px : 2 * line.dash_px) - in_period;
            const double to = std::min(whole, at + std::max(rest, 1e-3));
            const auto point = [&](double t) {
                return Pixel{a.x + (b.x - a.x) * t / whole, a.y + (b.y - a.y) * t / whole};
            };
            if (drawn)
                dashes.push_back({point(at), point(to)});
            at = to;
        }
        done += whole;
    }
    return dashes;
}

void paintLine(Picture& picture, Mask& mask, const OverlayLine& line)
{
    for (const bool rim : {true, false}) {
        mask.clear();
        for (const auto& dash : dashesOf(line))
            for (std::size_t n = 0; n + 1 < dash.size(); ++n)
                mask.addSegment(dash[n], dash[n + 1], line.width_px + (rim ? 2 * kRim_px : 0));
        mask.blendInto(picture, rim ? kRimColor : line.color, rim ? kRimStrength : 1);
    }
}

void paintDisc(Picture& picture, Mask& mask, const OverlayDisc& disc)
{
    for (const bool rim : {true, false}) {
        const double more = rim ? kRim_px : 0;
        const bool ring = disc.ring_px > 0;
        const double inner = ring ? disc.radius_px - disc.ring_px / 2 - more : -1;
        const double outer = disc.radius_px + (ring ? disc.ring_px / 2 : 0) + more;
        mask.clear();
        mask.addRing(disc.centre, inner, outer);
        mask.blendInto(picture, rim ? kRimColor : disc.color, rim ? kRimStrength : 1);
    }
}

// A marker's name beside its ring, at the picture's edge.
PlacedText movedInto(const Picture& picture, PlacedText text, Pixel at)
{
    if (at.x < 0 || at.y < 0 || at.x > picture.width || at.y > picture.height)
        return text;
    const Area area = areaOf(text);
    text.begin.x += std::max(0.0, -area.x) - std::clamp(area.right() - picture.width, 0.0, std::max(0.0, area.x));
    text.begin.y += std::max(0.0, -area.y) - std::clamp(area.bottom() - picture.height, 0.0, std::max(0.0, area.y));
    text.begin = {std::round(text.begin.x), std::round(text.begin.y)};
    return text;
}

}  // namespace

Picture::Picture(int w, int h, Rgb ground) : width(w), height(h), rgb(std::size_t(w) * std::size_t(h) * 3)
{
    for (std::size_t n = 0; n < rgb.size(); n += 3) {
        rgb[n] = ground.red;
        rgb[n + 1] = ground.green;
        rgb[n + 2] = ground.blue;
    }
}

Rgb Picture::at(int x, int y) const
{
    const std::size_t n = (std::size_t(y) * std::size_t(width) + std::size_t(x)) * 3;
    return {rgb[n], rgb[n + 1], rgb[n + 2]};
}

void Picture::set(int x, int y, Rgb color)
{
    const std::size_t n = (std::size_t(y) * std::size_t(width) + std::size_t(x)) * 3;
    rgb[n] = color.red;
    rgb[n + 1] = color.green;
    rgb[n + 2] = color.blue;
}

void paint(Picture& picture, const Overlay& overlay)
{
    Mask mask(picture.width, picture.height), rim(picture.width, picture.height);
    std::vector<PlacedText> texts = layOut(overlay.texts);
    for (std::size_t n = 0; n < texts.size(); ++n)
        texts[n] = movedInto(picture, texts[n], overlay.texts[n].at);
    paintGround(picture, texts, mask);  // not over lines and discs: markers stay as bright as they are
    for (const OverlayLine& line : overlay.lines)
        paintLine(picture, mask, line);
    for (const OverlayDisc& disc : overlay.discs)
        paintDisc(picture, mask, disc);
    for (const PlacedText& text : texts)
        paintText(picture, text, mask, rim);
}

TextSize textSize(const OverlayText& text)
{
    return sizeOf(layOut({text}).front());
}

Area textArea(const OverlayText& text)
{
    return areaOf(layOut({text}).front());
}

std::vector<Area> textAreas(const Overlay& overlay)
{
    std::vector<Area> areas;
    for (const PlacedText& text : layOut(overlay.texts))
        areas.push_back(areaOf(text));
    return areas;
}

void copyInto(Picture& target, const Picture& source, int x, int y)
{
    for (int row = 0; row < source.height; ++row)
        for (int column = 0; column < source.width; ++column)
            if (x + column >= 0 && x + column < target.width && y + row >= 0 && y + row < target.height)
                target.set(x + column, y + row, source.at(column, row));
}

void writePng(const std::filesystem::path& file, const Picture& picture)
{
    picture::writePng(file, picture.width, picture.height, picture.rgb, {.says_srgb = true});
}

}  // namespace vicon::viewer
