#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace vicon::ingest {

/// What the elements of a file look like before a DICOM library sees them: tags, lengths and nesting, no values.
struct Structure {
    enum class Fate {
        clear,    ///< every element was followed to the end, within the limits
        odd,      ///< something that a library may understand, or not: reading it here first would be a risk
        refused,  ///< `why` says what is wrong
    };
    Fate fate = Fate::odd;
    std::string why;
    /// Bytes behind the pixels, at the end, that are no element; 0 where the file ends with one.
    std::uint64_t trailing_bytes = 0;
    /// Of a refused file: everything before its pixels is whole and may be read, so that it can be named.
    bool clear_until_pixels = false;
    /// UID of a clear file, under which DCMTK reads its data set, too.
    std::string transfer_syntax;
};

/// Follows the elements of a file without recursion and without memory for their values. Refused are sequences nested
/// deeper than kDeepestSequence, headers that cost too much (header_cost.h), elements longer than the file, types of
/// directory records longer than a code may be, deflated data larger than kLargestDeflated, and what does not begin as
/// DICOM.
Structure scanStructure(const std::filesystem::path& file);

/// Structured reports, which nest deepest, stay well below.
inline constexpr int kDeepestSequence = 64;
inline constexpr std::uint64_t kLargestDeflated = 128'000'000;

}  // namespace vicon::ingest
