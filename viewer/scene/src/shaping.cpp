#include "shaping.h"

#include <fribidi.h>
#include <hb-ft.h>
#include <hb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

namespace vicon::viewer {
namespace {

constexpr double kFixed = 64;  // FreeType and HarfBuzz count in 64ths of a pixel

struct Letter {
    std::uint32_t character = 0;
    FriBidiLevel level = 0;  // odd: from right to left
};

/// Letters that one font writes in one direction and one script.
struct Run {
    std::vector<std::uint32_t> characters;
    FT_Face face = nullptr;
    FriBidiLevel level = 0;
    hb_script_t script = HB_SCRIPT_COMMON;
};

// Marks of direction have done their work when the levels are known. U+200C and U+200D join or part letters and stay.
bool isInvisible(std::uint32_t c)
{
    return c < 0x20 || c == 0x7f || c == FRIBIDI_CHAR_FILL || c == 0x200B || c == 0x200E || c == 0x200F ||
           (c >= 0x202A && c <= 0x202E) || (c >= 0x2060 && c <= 0x2069);
}

/// Joins letters or keeps them apart, whichever font they are of.
bool isJoiner(std::uint32_t c)
{
    return c == 0x200C || c == 0x200D;
}

bool isPlain(const std::vector<Letter>& letters)
{
    constexpr std::uint32_t kFirstCombiningMark = 0x300;
    return std::all_of(letters.begin(), letters.end(),
                       [](const Letter& l) { return l.character < kFirstCombiningMark && l.level % 2 == 0; });
}

std::vector<Letter> lettersOf(const std::string& utf8)
{
    std::vector<FriBidiChar> text(utf8.size() + 1);
    const auto count =
        fribidi_charset_to_unicode(FRIBIDI_CHAR_SET_UTF8, utf8.data(), FriBidiStrIndex(utf8.size()), text.data());
    if (count == 0)
        return {};
    std::vector<FriBidiCharType> types(std::size_t(count), 0);
    std::vector<FriBidiBracketType> brackets(types.size());
    std::vector<FriBidiLevel> levels(types.size());
    fribidi_get_bidi_types(text.data(), count, types.data());
    fribidi_get_bracket_types(text.data(), count, types.data(), brackets.data());
    FriBidiParType base = FRIBIDI_PAR_WLTR;
    if (fribidi_get_par_embedding_levels_ex(types.data(), brackets.data(), count, &base, levels.data()) == 0)
        std::fill(levels.begin(), levels.end(), FriBidiLevel(0));
    std::vector<Letter> letters;
    for (std::size_t n = 0; n < levels.size(); ++n)
        if (!isInvisible(text[n]))
            letters.push_back({text[n], levels[n]});
    return letters;
}

/// What no font has is called by its number: a box would not say what is missing.
std::vector<Letter> withoutBoxes(Fonts& fonts, const std::vector<Letter>& letters)
{
    std::vector<Letter> out;
    for (const Letter& letter : letters) {
        if (isJoiner(letter.character) || fonts.find(letter.character).face) {
            out.push_back(letter);
            continue;
        }
        std::array<char, 16> number{};
        const int length = std::snprintf(number.data(), number.size(), "[U+%04X]", unsigned(letter.character));
        for (int n = 0; n < length; ++n)
            out.push_back({std::uint32_t(number[std::size_t(n)]), FriBidiLevel(letter.level + letter.level % 2)});
    }
    return out;
}

bool belongsToAnyScript(hb_script_t script)
{
    return script == HB_SCRIPT_COMMON || script == HB_SCRIPT_INHERITED || script == HB_SCRIPT_UNKNOWN;
}

std::vector<Run> runsOf(Fonts& fonts, const std::vector<Letter>& letters)
{
    hb_unicode_funcs_t* const unicode = hb_unicode_funcs_get_default();
    std::vector<Run> runs;
    for (const Letter& letter : letters) {
        const hb_script_t script = hb_unicode_script(unicode, letter.character);
        if (isJoiner(letter.character)) {
            if (!runs.empty())
                runs.back().characters.push_back(letter.character);
            continue;
        }
        const bool accent = script == HB_SCRIPT_INHERITED && !runs.empty();  // of its letter's font, where that has it
        FT_Face face = accent && FT_Get_Char_Index(runs.back().face, letter.character) != 0
                           ? runs.back().face
                           : fonts.find(letter.character).face;
        const bool any = belongsToAnyScript(script);
        if (runs.empty() || runs.back().face != face || runs.back().level != letter.level ||
            (!any && !belongsToAnyScript(runs.back().script) && runs.back().script != script))
            runs.push_back({{}, face, letter.level, HB_SCRIPT_COMMON});
        runs.back().characters.push_back(letter.character);
        if (!any)
            runs.back().script = script;
    }
    return runs;
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

void append(GlyphRow& row, Fonts& fonts, const Run& run, double size_px)
{
    setSize(run.face, size_px);
    hb_font_t* const font = fonts.shaperOf(run.face);
    hb_ft_font_changed(font);  // its size
    const std::unique_ptr<hb_buffer_t, decltype(&hb_buffer_destroy)> buffer(hb_buffer_create(), hb_buffer_destroy);
    const int count = int(run.characters.size());
    hb_buffer_add_utf32(buffer.get(), run.characters.data(), count, 0, count);
    hb_buffer_set_direction(buffer.get(), run.level % 2 == 1 ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
    hb_buffer_set_script(buffer.get(), run.script);
    hb_shape(font, buffer.get(), nullptr, 0);
    unsigned glyphs = 0;
    const hb_glyph_info_t* info = hb_buffer_get_glyph_infos(buffer.get(), &glyphs);
    const hb_glyph_position_t* at = hb_buffer_get_glyph_positions(buffer.get(), &glyphs);
    for (unsigned n = 0; n < glyphs; ++n) {
        row.glyphs.push_back(
            {{run.face, info[n].codepoint}, row.width + at[n].x_offset / kFixed, at[n].y_offset / kFixed});
        row.width += at[n].x_advance / kFixed;
    }
}

/// Letters that stand side by side as they are: nearly every text, in a fraction of the time.
GlyphRow plainRow(Fonts& fonts, const std::vector<Letter>& letters, double size_px)
{
    GlyphRow row;
    for (const Letter& letter : letters) {
        const auto glyph = fonts.find(letter.character);
        setSize(glyph.face, size_px);
        if (FT_Load_Glyph(glyph.face, glyph.glyph, FT_LOAD_NO_HINTING) != 0)
            continue;
        row.glyphs.push_back({glyph, row.width});
        row.width += double(glyph.face->glyph->linearHoriAdvance) / 65536.0;
    }
    return row;
}

}  // namespace

void setSize(FT_Face face, double size_px)
{
    FT_Set_Char_Size(face, 0, FT_F26Dot6(std::lround(size_px * kFixed)), 72, 72);
}

GlyphRow shaped(Fonts& fonts, const std::string& utf8, double size_px)
{
    const auto letters = withoutBoxes(fonts, lettersOf(utf8));
    if (isPlain(letters))
        return plainRow(fonts, letters, size_px);
    auto runs = runsOf(fonts, letters);
    putInVisualOrder(runs);
    GlyphRow row;
    for (const Run& run : runs)
        append(row, fonts, run, size_px);
    return row;
}

}  // namespace vicon::viewer
