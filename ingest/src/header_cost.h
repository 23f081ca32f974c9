#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace vicon::ingest {

/// What reading the header of an object may cost. Of one data set or item a library walks over all elements whenever it
/// looks one up, and walks back from the end to put one that is out of order into its place.
/// @{
/// A multi-frame object of 5000 frames has some 300,000.
inline constexpr std::size_t kMostElements = 500000;
/// The richest headers, with makers' blocks of their own, hold some 2000.
inline constexpr std::size_t kMostElementsOfItem = 10000;
/// A tenth of a second. Writers that do not sort put a few elements of some hundreds wrong.
inline constexpr std::size_t kMostStepsBack = 10'000'000;
/// Everything but the pixels. The richest multi-frame objects hold a tenth.
inline constexpr std::uint64_t kMostHeaderBytes = 128'000'000;
/// @}

/// The elements of one data set or item.
struct ItemTally {
    std::size_t elements = 0;
    std::uint32_t highest_tag = 0;
};

/// Adds up what the header of one object costs. What exceeds a limit is said: why the object is refused, else nothing.
class HeaderCost {
public:
    /// An item, or a fragment of compressed pixels.
    std::string addPart();
    /// An element.
    /// @param tag group and element, the group in the upper half; nothing where the order in which the elements were
    ///        written is not known: the worst is assumed
    /// @param bytes of its value where they are part of the header, else 0
    std::string addElement(ItemTally& item, std::optional<std::uint32_t> tag, std::uint64_t bytes);

private:
    std::size_t elements_ = 0, steps_back_ = 0;
    std::uint64_t bytes_ = 0;
};

}  // namespace vicon::ingest
