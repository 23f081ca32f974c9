#pragma once

#include <map>
#include <string>

#include "haru.h"
#include "vicon/text/typesetter.h"

namespace vicon::report {

/// Writes lines on pages. A word whose letters are their fonts' own glyphs side by side, which is all that libharu can
/// write, is text. Any other word, as of a script that joins, stacks or reorders its letters or of a font that libharu
/// cannot load, is drawn as outlines with invisible text over it, so that it is found and copied all the same.
class PdfText {
public:
    PdfText(Haru& haru, text::FontSet& fonts) : haru_(haru), fonts_(fonts) {}

    /// In the page's colour of filling. `x`, `y`: left end of the base line.
    void write(HPDF_Page page, double x, double y, const text::TextLine& line);
    /// Once everything is written: what the fonts' codes mean.
    void finish();

private:
    struct UsedFont {
        HPDF_Font font = nullptr;              ///< null: libharu cannot load it
        std::map<char16_t, char32_t> meaning;  ///< of the codes used
    };
    /// Glyphs [from, to) of a run.
    struct Word {
        const text::GlyphRun& run;
        std::size_t from, to;
        double x, y, size;  ///< of the line
    };

    UsedFont& load(int font);
    bool isCarried(const text::GlyphRun& run, const text::PlacedGlyph& glyph);
    void writeText(HPDF_Page page, const Word& word);
    void drawOutlines(HPDF_Page page, const Word& word) const;
    void writeInvisibly(HPDF_Page page, const Word& word);
    char16_t codeFor(char32_t hidden);

    Haru& haru_;
    text::FontSet& fonts_;
    std::map<int, UsedFont> loaded_;
    std::map<char32_t, char16_t> hidden_;  ///< codes of invisible characters
};

}  // namespace vicon::report
