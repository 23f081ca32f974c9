#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "fonts.h"

namespace vicon::report {

/// Glyphs of one font, in the order in which they stand from left to right.
struct TextRun {
    int font = 0;
    std::u16string codes;
    double x = 0;  ///< from the line's left edge, points
};

struct TextLine {
    std::vector<TextRun> runs;
    double width = 0;  ///< points
    double size = 0;   ///< of the font, points
    bool right_to_left = false;
};

struct TextStyle {
    double size = 9;  ///< points
    bool bold = false;
};

/// Turns UTF-8 text into lines of glyphs: normalised, broken to a width, joined (Arabic) and put into visual order
/// (Unicode bidirectional algorithm, each paragraph's direction by its first strong character).
/// A character that no font has becomes its code point in brackets, and is counted.
class Typesetter {
public:
    explicit Typesetter(const FontSet& fonts) : fonts_(fonts) {}

    /// At least one line. A word wider than `max_width` is broken where it must be.
    std::vector<TextLine> lines(std::string_view utf8, TextStyle style, double max_width);
    /// The text in one line, however wide.
    TextLine line(std::string_view utf8, TextStyle style);

    /// The characters that were replaced, each once: a code point, or kInvalidUtf8.
    const std::set<char32_t>& missing() const { return missing_; }
    static constexpr char32_t kInvalidUtf8 = 0xfffd;

private:
    std::u32string printable(std::string_view utf8, FontSet::Wish& wish);
    void breakParagraph(const std::u32string& text, TextStyle style, FontSet::Wish wish, double max_width,
                        std::vector<TextLine>& out) const;

    const FontSet& fonts_;
    std::set<char32_t> missing_;
};

}  // namespace vicon::report
