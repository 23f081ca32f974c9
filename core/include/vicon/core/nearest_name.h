#pragma once

#include <string>
#include <vector>

namespace vicon {

/// The name that a mistyped one may mean: the first of those that take the fewest letters to change, at most
/// `most_letters`. Empty where none is so near.
std::string nearestName(const std::string& typed, const std::vector<std::string>& names, std::size_t most_letters);

}  // namespace vicon
