#include "break_lines.h"

#include <unicode/brkiter.h>
#include <unicode/uchar.h>
#include <unicode/unistr.h>

#include <memory>

#include "paragraph.h"
#include "vicon/core/error.h"

namespace vicon::text {
namespace {

/// Goes with the letter before it.
bool isAttached(char32_t c)
{
    return (U_GET_GC_MASK(UChar32(c)) & U_GC_M_MASK) != 0 || isJoiner(c);
}

/// Where a line may end: offsets into the text.
std::vector<std::size_t> breakOffsets(std::u32string_view text)
{
    const icu::UnicodeString utf16 =
        icu::UnicodeString::fromUTF32(reinterpret_cast<const UChar32*>(text.data()), std::int32_t(text.size()));
    UErrorCode status = U_ZERO_ERROR;
    const std::unique_ptr<icu::BreakIterator> breaks(
        icu::BreakIterator::createLineInstance(icu::Locale::getRoot(), status));
    if (U_FAILURE(status))
        throw Error(ErrorCode::internal, "lines cannot be broken", u_errorName(status));
    breaks->setText(utf16);
    std::vector<std::size_t> out;
    std::int32_t last = 0;
    std::size_t characters = 0;
    for (std::int32_t at = breaks->next(); at != icu::BreakIterator::DONE; last = at, at = breaks->next())
        out.push_back(characters += std::size_t(utf16.countChar32(last, at - last)));
    return out;
}

std::size_t withoutTrailingSpaces(std::u32string_view text, std::size_t from, std::size_t to)
{
    while (to > from && u_isUWhiteSpace(UChar32(text[to - 1])))
        --to;
    return to;
}

}  // namespace

std::vector<LineSpan> breakLines(std::u32string_view text, double max_width, const Measure& measure)
{
    const std::vector<std::size_t> breaks = breakOffsets(text);
    const auto trimmed = [&](std::size_t from, std::size_t to) {
        return LineSpan{from, withoutTrailingSpaces(text, from, to)};
    };
    const auto fits = [&](std::size_t from, std::size_t to) {
        const LineSpan line = trimmed(from, to);
        return line.from == line.to || measure(line.from, line.to) <= max_width;
    };
    std::vector<LineSpan> out;
    auto next = breaks.begin();
    for (std::size_t from = 0, to = 0; from < text.size(); from = to) {
        double width = 0;  // of whole words one by one, nearly that of the line
        while (next != breaks.end() && *next <= from)
            ++next;
        auto end = next;
        for (std::size_t word = from; end != breaks.end(); word = *end++) {
            const LineSpan letters = trimmed(word, *end);
            const double letters_width = measure(letters.from, letters.to);
            if (width + letters_width > max_width)
                break;
            width += letters_width + measure(letters.to, *end);
        }
        while (end != next && !fits(from, *(end - 1)))
            --end;
        to = end == next ? from : *(end - 1);
        if (to == from)  // a word wider than the line
            for (to = from + 1; to < text.size() && (isAttached(text[to]) || fits(from, to + 1));)
                ++to;
        out.push_back(trimmed(from, to));
    }
    return out;
}

}  // namespace vicon::text
