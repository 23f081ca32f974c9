#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "vicon/viewer/model/overlay.h"

namespace vicon::viewer {

/// A picture of eight bits a colour, row by row from the top: red, green, blue.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;

    Picture() = default;
    Picture(int w, int h, Rgb ground = {0, 0, 0});
    Rgb at(int x, int y) const;
    void set(int x, int y, Rgb color);
};

/// Paints lines, discs and texts over a picture, smoothed. Texts may be in any script for which a font is installed;
/// right-to-left ones are ordered and joined. A text that begins in the picture is moved until it ends there, too, as
/// far as it fits. A character that no font has is called by its number, as [U+0378].
void paint(Picture& picture, const Overlay& overlay);

/// Width and height of a line of text as paint() would draw it, in pixels.
struct TextSize {
    double width_px = 0, height_px = 0;
};
TextSize textSize(const OverlayText& text);
/// What a line of text as paint() would draw it takes of a picture that is large enough.
Area textArea(const OverlayText& text);
/// The same of each of an overlay's texts: those of one block have one size.
std::vector<Area> textAreas(const Overlay& overlay);

/// Puts a picture into another one; what does not fit is cut off.
void copyInto(Picture& target, const Picture& source, int x, int y);

/// Writes a PNG by replaceFile(). Throws Error{store}.
void writePng(const std::filesystem::path& file, const Picture& picture);

}  // namespace vicon::viewer
