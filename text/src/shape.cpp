#include "shape.h"

#include <hb-ft.h>
#include <hb.h>
#include FT_ADVANCES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "font_size.h"
#include "vicon/text/glyph.h"

namespace vicon::text {
namespace {

constexpr int kAnyFont = -1;     // of a character that only steers shaping
constexpr double kStays = 1e-3;  // of the size: less than this is no move

constexpr std::array<hb_feature_t, 2> kSeparate{
    {{HB_TAG('l', 'i', 'g', 'a'), 0, HB_FEATURE_GLOBAL_START, HB_FEATURE_GLOBAL_END},
     {HB_TAG('c', 'l', 'i', 'g'), 0, HB_FEATURE_GLOBAL_START, HB_FEATURE_GLOBAL_END}}};

/// Letters that one font writes in one direction and one script.
struct Run {
    int font = 0;
    FriBidiLevel level = 0;
    hb_script_t script = HB_SCRIPT_COMMON;
    std::u32string text;
};

bool belongsToAnyScript(hb_script_t script)
{
    return script == HB_SCRIPT_COMMON || script == HB_SCRIPT_INHERITED || script == HB_SCRIPT_UNKNOWN;
}

struct Letter {
    char32_t character = 0;
    FriBidiLevel level = 0;  // odd: from right to left
    hb_script_t script = HB_SCRIPT_INHERITED;
    int font = kAnyFont;
};

std::vector<Letter> lettersOf(FontSet& fonts, const Paragraph& paragraph, std::size_t from, std::size_t to,
                              FontStyle style)
{
    hb_unicode_funcs_t* const unicode = hb_unicode_funcs_get_default();
    std::vector<Letter> letters;
    for (std::size_t n = from; n < to; ++n) {
        Letter letter{paragraph.text[n], paragraph.levels[n]};
        if (isSpent(letter.character) || (isJoiner(letter.character) && letters.empty()))
            continue;
        if (!isJoiner(letter.character)) {
            letter.script = hb_unicode_script(unicode, letter.character);
            const bool accent = letter.script == HB_SCRIPT_INHERITED && !letters.empty();
            const int below = accent ? letters.back().font : kAnyFont;  // whose font it is of, where that has it
            letter.font = below != kAnyFont && glyphOf(fonts, below, letter.character) != 0
                              ? below
                              : fonts.find(letter.character, style).value_or(0);
        }
        letters.push_back(letter);
    }
    return letters;
}

/// A word of one script is of one font, where one has all of it: letters of two fonts neither join nor stack.
void uniteFonts(std::vector<Letter>& letters, FontSet& fonts, FontStyle style)
{
    for (auto from = letters.begin(), to = from; from != letters.end(); from = to) {
        to = std::find_if(from + 1, letters.end(), [&](const Letter& l) {
            return (l.script != from->script && l.script != HB_SCRIPT_INHERITED) || l.level != from->level;
        });
        std::u32string word;
        bool mixed = false;
        for (auto at = from; at != to; ++at)
            if (at->font != kAnyFont) {
                word += at->character;
                mixed = mixed || at->font != from->font;
            }
        if (const auto one = mixed && !belongsToAnyScript(from->script) ? fonts.findForAll(word, style) : std::nullopt)
            for (auto at = from; at != to; ++at)
                if (at->font != kAnyFont)
                    at->font = *one;
    }
}

std::vector<Run> runsOf(const std::vector<Letter>& letters)
{
    std::vector<Run> runs;
    for (const Letter& letter : letters) {
        const bool any = belongsToAnyScript(letter.script);
        if (letter.font != kAnyFont &&
            (runs.empty() || runs.back().font != letter.font || runs.back().level != letter.level ||
             (!any && !belongsToAnyScript(runs.back().script) && runs.back().script != letter.script)))
            runs.push_back({letter.font, letter.level, HB_SCRIPT_COMMON, {}});
        runs.back().text += letter.character;
        if (!any)
            runs.back().script = letter.script;
    }
    return runs;
}

/// Written letter by letter: ligatures are ornaments there, and a word looks the same beside any other.
bool isSpelt(hb_script_t script)
{
    return script == HB_SCRIPT_COMMON || script == HB_SCRIPT_LATIN || script == HB_SCRIPT_GREEK ||
           script == HB_SCRIPT_CYRILLIC;
}

/// From left to right: rule L2 of Unicode's annex 9.
void putInVisualOrder(std::vector<Run>& runs)
{
    FriBidiLevel highest = 0;
    for (const Run& run : runs)
        highest = std::max(highest, run.level);
    for (FriBidiLevel level = highest; level >= 1; --level)
        for (auto from = runs.begin(); from != runs.end();) {
            from = std::find_if(from, runs.end(), [&](const Run& r) { return r.level >= level; });
            const auto to = std::find_if(from, runs.end(), [&](const Run& r) { return r.level < level; });
            std::reverse(from, to);
            from = to;
        }
}

/// Of the characters of a glyph's cluster: the one whose own glyph it is.
char32_t ownCharacter(const FontSet& fonts, const GlyphRun& run, std::size_t n)
{
    const PlacedGlyph& glyph = run.glyphs[n];
    const auto same = [&](std::size_t other) {
        return other < run.glyphs.size() && run.glyphs[other].cluster == glyph.cluster;
    };
    std::size_t end = run.text.size();  // of the cluster
    for (const PlacedGlyph& other : run.glyphs)
        if (other.cluster > glyph.cluster)
            end = std::min(end, other.cluster);
    if (same(n + 1) || same(n - 1) || end != glyph.cluster + 1)
        return 0;
    const char32_t c = run.text[glyph.cluster];
    if (glyphOf(fonts, run.font, c) == glyph.glyph)
        return c;
    FriBidiChar mirrored = c;
    fribidi_get_mirror_char(c, &mirrored);
    return run.right_to_left && glyphOf(fonts, run.font, mirrored) == glyph.glyph ? mirrored : 0;
}

void append(TextLine& line, FontSet& fonts, const Run& run)
{
    setSize(fonts.face(run.font), line.size);
    hb_font_t* const font = fonts.shaper(run.font);
    hb_ft_font_changed(font);  // its size
    const std::unique_ptr<hb_buffer_t, decltype(&hb_buffer_destroy)> buffer(hb_buffer_create(), hb_buffer_destroy);
    const int count = int(run.text.size());
    hb_buffer_add_utf32(buffer.get(), reinterpret_cast<const std::uint32_t*>(run.text.data()), count, 0, count);
    const bool right_to_left = run.level % 2 == 1;
    hb_buffer_set_direction(buffer.get(), right_to_left ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
    hb_buffer_set_script(buffer.get(), run.script);
    hb_shape(font, buffer.get(), kSeparate.data(), isSpelt(run.script) ? unsigned(kSeparate.size()) : 0);
    unsigned glyphs = 0;
    const hb_glyph_info_t* info = hb_buffer_get_glyph_infos(buffer.get(), &glyphs);
    const hb_glyph_position_t* at = hb_buffer_get_glyph_positions(buffer.get(), &glyphs);
    GlyphRun& out = line.runs.emplace_back(GlyphRun{run.font, right_to_left, run.text, {}});
    for (unsigned n = 0; n < glyphs; ++n) {
        const double advance = at[n].x_advance / kFixed;
        out.glyphs.push_back({info[n].codepoint, line.width + at[n].x_offset / kFixed, at[n].y_offset / kFixed,
                              line.width, advance, info[n].cluster});
        line.width += advance;
    }
    const double stays = kStays * line.size * kFixed;
    for (std::size_t n = 0; n < out.glyphs.size(); ++n)
        if (std::abs(at[n].y_offset) <= stays && (std::abs(at[n].x_offset) <= stays || at[n].x_advance > 0))
            out.glyphs[n].character = ownCharacter(fonts, out, n);
}

bool isPlain(const Paragraph& paragraph, std::size_t from, std::size_t to)
{
    constexpr char32_t kFirstCombiningMark = 0x300;
    for (std::size_t n = from; n < to; ++n)
        if (paragraph.text[n] >= kFirstCombiningMark || paragraph.levels[n] % 2 == 1)
            return false;
    return true;
}

/// Letters that stand side by side as they are: nearly every text, in a fraction of the time.
void appendPlain(TextLine& line, FontSet& fonts, std::u32string_view text, FontStyle style)
{
    for (const char32_t c : text) {
        const int font = fonts.find(c, style).value_or(0);
        FT_Face face = fonts.face(font);
        if (line.runs.empty() || line.runs.back().font != font) {
            setSize(face, line.size);
            line.runs.push_back({font, false, {}, {}});
        }
        GlyphRun& run = line.runs.back();
        const FT_UInt glyph = FT_Get_Char_Index(face, c);
        FT_Fixed units = 0;
        if (FT_Get_Advance(face, glyph, FT_LOAD_NO_SCALE, &units) != 0)
            continue;
        const double advance = double(FT_MulDiv(units, face->size->metrics.x_scale, 64)) / 65536.0;
        run.glyphs.push_back({glyph, line.width, 0, line.width, advance, run.text.size(), c});
        run.text += c;
        line.width += advance;
    }
}

}  // namespace

TextLine shaped(FontSet& fonts, const Paragraph& paragraph, std::size_t from, std::size_t to, FontStyle style,
                double size)
{
    TextLine line{{}, 0, size, paragraph.right_to_left};
    if (isPlain(paragraph, from, to)) {
        appendPlain(line, fonts, std::u32string_view(paragraph.text).substr(from, to - from), style);
        return line;
    }
    std::vector<Letter> letters = lettersOf(fonts, paragraph, from, to, style);
    uniteFonts(letters, fonts, style);
    std::vector<Run> runs = runsOf(letters);
    putInVisualOrder(runs);
    for (const Run& run : runs)
        append(line, fonts, run);
    return line;
}

}  // namespace vicon::text
