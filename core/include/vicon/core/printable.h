#pragma once

#include <string>
#include <string_view>

namespace vicon {

/// A text that came from outside as it may be shown: valid UTF-8 in which nothing commands a terminal or forges a line.
/// Bytes that are no UTF-8 become U+FFFD. Control characters (C0, DEL, C1), line and paragraph separators and marks
/// that turn the direction of writing become escapes: \x1b, \n, \u202e. Everything else stays as it is.
std::string printable(std::string_view text);

/// The beginning of a UTF-8 text that came from outside, with "..." behind it where there is more.
std::string shortened(const std::string& text, int most_characters);

}  // namespace vicon
