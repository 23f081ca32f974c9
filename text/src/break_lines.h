#pragma once

#include <functional>
#include <string_view>
#include <vector>

namespace vicon::text {

/// Characters [from, to) of a text, without the spaces at the end of the line that they make.
struct LineSpan {
    std::size_t from = 0, to = 0;
};

/// Width of the characters [from, to) as one line.
using Measure = std::function<double(std::size_t from, std::size_t to)>;

/// Breaks a text where its language and script allow it (ICU), so that no line is wider than `max_width`. A word that
/// is wider is broken between two letters. Throws Error{internal}.
std::vector<LineSpan> breakLines(std::u32string_view text, double max_width, const Measure& measure);

}  // namespace vicon::text
