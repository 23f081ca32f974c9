#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

struct Rgb {
    std::uint8_t red = 255, green = 255, blue = 255;
    friend bool operator==(Rgb, Rgb) = default;
};

/// A rectangle of a picture, in pixels.
struct Area {
    double x = 0, y = 0, width = 0, height = 0;
    double right() const { return x + width; }
    double bottom() const { return y + height; }
    Pixel centre() const { return {x + width / 2, y + height / 2}; }
};

struct OverlayLine {
    std::vector<Pixel> points;
    Rgb color;
    double width_px = 1;
    double dash_px = 0;  ///< length of dashes and of the gaps between them; 0: solid
};

struct OverlayDisc {
    Pixel centre;
    double radius_px = 3;
    Rgb color;
    double ring_px = 0;  ///< thickness of a ring; 0: a full disc
};

enum class Across { left, centre, right };
enum class Along { top, middle, bottom };

/// A line of text, any script, in reading order. It has a dark rim, so that it reads on every ground.
struct OverlayText {
    Pixel at;
    std::string text;  ///< UTF-8
    double height_px = 14;
    Rgb color;
    Across across = Across::left;
    Along along = Along::top;
    double most_width_px = 1e9;  ///< made smaller until it fits, to three fifths; then cut off with "…"
    int block = 0;               ///< all texts of a block (not 0) are written as small as its smallest
};

/// What is written over a picture, in order lines, discs, texts. Painted by scene/canvas.h into pictures and by the
/// reading room into its window.
struct Overlay {
    std::vector<OverlayLine> lines;
    std::vector<OverlayDisc> discs;
    std::vector<OverlayText> texts;
};

}  // namespace vicon::viewer
