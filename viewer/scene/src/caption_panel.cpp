#include "caption_panel.h"

#include <algorithm>
#include <cmath>

#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/scene/canvas.h"

namespace vicon::viewer {
namespace {

constexpr double kTextSizes[] = {1.3, 1.15, 1.0};  // of a picture's usual text, the wanted one first
constexpr double kMostSide = 0.6, kWantedSide = 0.45, kLeastSide = 0.25;  // of the panel's height
constexpr double kLeastSide_px = 60;                                      // less has no room for its own letters

bool touch(const Area& a, const Area& b)
{
    return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

/// The largest square in the lower right corner that touches no text.
Area roomBeside(const std::vector<Area>& texts, int width, int height, double margin_px)
{
    for (double side = std::floor(kMostSide * height); side >= std::max(kLeastSide_px, kLeastSide * height); --side) {
        const Area square{std::floor(width - margin_px - side), std::floor(height - margin_px - side), side, side};
        if (square.x >= margin_px &&
            std::none_of(texts.begin(), texts.end(), [&](const Area& text) { return touch(square, text); }))
            return square;
    }
    return {};
}

/// All that is left below the texts.
Area roomBelow(const std::vector<Area>& texts, int width, int height)
{
    double top = 0;
    for (const Area& text : texts)
        top = std::max(top, std::ceil(text.bottom()));
    const Area below{0, top, double(width), height - top};
    return below.height >= std::max(kLeastSide_px, kLeastSide * height) ? below : Area{};
}

/// Whichever shows more: the scale of a close-up goes by its shorter side.
Area roomFor(const Overlay& overlay, int width, int height, double margin_px)
{
    const std::vector<Area> texts = textAreas(overlay);
    const Area below = roomBelow(texts, width, height), beside = roomBeside(texts, width, height, margin_px);
    return std::min(below.width, below.height) >= beside.height ? below : beside;
}

CaptionPanel withTextOf(double text_px, std::vector<OverlayText> lines, int width, int height)
{
    const Area area{text_px / 2, text_px / 2, width - text_px, height - text_px};
    const auto room = std::size_t(linesIn(area.height, text_px));
    if (lines.size() > room) {
        lines.resize(room);
        lines.back().text += " …";
    }
    CaptionPanel panel;
    addLines(panel.overlay, area, lines, text_px);
    panel.close_up = roomFor(panel.overlay, width, height, text_px);
    return panel;
}

}  // namespace

CaptionPanel captionPanel(const std::vector<OverlayText>& lines, int width, int height, double pixel_ratio)
{
    CaptionPanel panel;
    for (const double size : kTextSizes) {
        panel = withTextOf(size * textHeightFor(width, height, pixel_ratio), lines, width, height);
        if (panel.close_up.height >= kWantedSide * height)
            break;
    }
    return panel;
}

}  // namespace vicon::viewer
