#include "paragraph.h"

#include "vicon/core/error.h"

namespace vicon::text {

Paragraph paragraphOf(std::u32string text)
{
    Paragraph out{std::move(text), {}, false};
    const std::vector<FriBidiChar> characters(out.text.begin(), out.text.end());
    const auto size = FriBidiStrIndex(characters.size());
    std::vector<FriBidiCharType> types(characters.size());
    std::vector<FriBidiBracketType> brackets(characters.size());
    out.levels.resize(characters.size());
    fribidi_get_bidi_types(characters.data(), size, types.data());
    fribidi_get_bracket_types(characters.data(), size, types.data(), brackets.data());
    FriBidiParType base = FRIBIDI_PAR_WLTR;
    if (size > 0 &&
        fribidi_get_par_embedding_levels_ex(types.data(), brackets.data(), size, &base, out.levels.data()) == 0)
        throw Error(ErrorCode::no_memory, "the direction of a text cannot be found");
    out.right_to_left = FRIBIDI_IS_RTL(base);
    return out;
}

bool isSpent(char32_t c)
{
    return c == 0x200b || c == 0x200e || c == 0x200f || c == 0x061c;
}

bool isJoiner(char32_t c)
{
    return c == 0x200c || c == 0x200d || (c >= 0xfe00 && c <= 0xfe0f) || (c >= 0xe0100 && c <= 0xe01ef);
}

}  // namespace vicon::text
