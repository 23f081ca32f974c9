#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vicon::ingest {

/// What a text of a DICOM object is: it decides where ISO 2022 designations end and what a backslash is.
enum class TextKind { person_name, single_line };

/// A DICOM text in UTF-8. Bytes that the character set cannot explain become U+FFFD, never a failure.
/// @param bytes as they stand in the object
/// @param character_sets the values of Specific Character Set, in order; the first may be empty. None at all: ASCII,
///        and bytes above 127 are taken as UTF-8 where they are valid UTF-8, else as Latin-1.
/// Source: DICOM PS3.5 section 6.1.2 and PS3.3 C.12.1.1.2.
std::string toUtf8(std::string_view bytes, const std::vector<std::string>& character_sets, TextKind kind);

/// Removes padding and what is empty at the end of a person name: "A^B^^^=C=" becomes "A^B=C".
std::string tidyPersonName(const std::string& name);

/// UTF-8 text in lower case without distinctions that only typing makes: case, repeated and trailing delimiters.
std::string foldedForComparison(const std::string& text);

}  // namespace vicon::ingest
