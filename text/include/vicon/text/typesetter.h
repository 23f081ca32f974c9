#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "vicon/text/font_set.h"

namespace vicon::text {

/// A glyph of a line. Lengths are in the unit of the text's size; x from the line's left end, y upwards from its base
/// line.
struct PlacedGlyph {
    unsigned glyph = 0;
    double x = 0, y = 0;  ///< of its origin
    double pen_x = 0;     ///< where its advance begins, without the offset that shaping gave it
    double advance = 0;
    std::size_t cluster = 0;  ///< the first of the run's characters that it stands for
    /// The one character that it stands for, where it is that character's own glyph beside its neighbours, kerned or
    /// not; 0: shaping replaced it, joined several or set it over another.
    char32_t character = 0;
};

/// Glyphs of one font and one direction, from left to right.
struct GlyphRun {
    int font = 0;
    bool right_to_left = false;
    std::u32string text;  ///< the characters, in the order in which they are read
    std::vector<PlacedGlyph> glyphs;
};

struct TextLine {
    std::vector<GlyphRun> runs;  ///< from left to right
    double width = 0;
    double size = 0;             ///< of the font
    bool right_to_left = false;  ///< its paragraph's direction

    /// Puts another line's glyphs to the right of this one's.
    void append(TextLine more);
};

struct TextStyle {
    double size = 9;  ///< of the font: points on paper, pixels on a screen
    bool bold = false;
};

/// Turns UTF-8 text into lines of glyphs as its scripts are written, the same for pictures and PDF: normalised (NFC),
/// broken to a width (ICU), put into visual order (FriBidi; each paragraph's direction by its first strong character)
/// and shaped (HarfBuzz). Characters that override directions are left out: they could turn a name. A character that no
/// font has becomes its code point in brackets, and is counted.
class Typesetter {
public:
    /// A screen's glyphs are measured at their size, as they are drawn; those on paper without rounding to pixels.
    explicit Typesetter(FontSet& fonts) : fonts_(fonts) {}

    /// At least one line. A word wider than `max_width` is broken where it must be.
    std::vector<TextLine> lines(std::string_view utf8, TextStyle style, double max_width);
    /// The text in one line, however wide.
    TextLine line(std::string_view utf8, TextStyle style);

    /// The characters that were replaced, each once: a code point, or kInvalidUtf8.
    const std::set<char32_t>& missing() const { return missing_; }
    static constexpr char32_t kInvalidUtf8 = 0xfffd;

private:
    std::u32string printable(std::string_view utf8, FontStyle& style);

    FontSet& fonts_;
    std::set<char32_t> missing_;
};

}  // namespace vicon::text
