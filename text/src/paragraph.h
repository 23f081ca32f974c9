#pragma once

#include <fribidi.h>

#include <string>
#include <vector>

namespace vicon::text {

/// A text without line ends, with the direction in which each of its characters is written.
struct Paragraph {
    std::u32string text;
    std::vector<FriBidiLevel> levels;  ///< odd: from right to left
    bool right_to_left = false;
};

/// By the bidirectional algorithm; the base direction is that of the first strong character.
Paragraph paragraphOf(std::u32string text);

/// Marks of direction and breaking, which have done their work when lines are shaped.
bool isSpent(char32_t c);
/// Joins letters, keeps them apart or chooses a form of them, whichever font they are of.
bool isJoiner(char32_t c);

}  // namespace vicon::text
