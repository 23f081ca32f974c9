#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vicon::ingest {

/// The lines of a header in words, and where its voxels may begin.
struct HeaderText {
    std::map<std::string, std::string> fields;  ///< names in lower case
    std::uint64_t bytes = 0;                    ///< up to the end of the last line
};

/// Reads lines "name SIGN value" until `isLast` says so of a line's name; a line that is none is given the name "".
/// Throws Error{bad_input} for a header that is longer than any program writes, that says something twice, or that ends
/// before its last line.
HeaderText readHeaderText(const std::filesystem::path& file, std::string_view sign,
                          const std::function<bool(const std::string& name)>& isLast);

/// The numbers of a text, in which brackets and commas count as spaces; nothing where anything else is among them.
std::optional<std::vector<double>> numbersIn(const std::string& text);
/// Nothing where there are not just so many.
std::optional<std::vector<double>> numbersIn(const std::string& text, std::size_t count);
std::string lowerCase(std::string text);

}  // namespace vicon::ingest
