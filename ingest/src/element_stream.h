#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "element_coding.h"
#include "header_cost.h"

namespace vicon::ingest {

/// Follows the elements of a data set as its bytes come, before a DICOM library sees them, with the limits that files
/// have: nesting (kDeepestSequence), what the header costs (header_cost.h), and no value longer than the data set may
/// be. It keeps no values. What no writer makes of a message is not followed, and refused: types that are none, values
/// without a length that are no sequence.
class ElementStream {
public:
    /// @param most_bytes that the whole data set may have
    ElementStream(Coding coding, std::uint64_t most_bytes);

    /// What is wrong as far as these bytes go; empty: nothing. Nothing may be added afterwards.
    std::string add(std::span<const unsigned char> bytes);

private:
    /// A place that holds elements or items.
    struct Level {
        std::uint64_t end;
        bool sequence;
        Coding coding;
        ItemTally tally{};
    };
    struct Head {
        std::uint32_t tag = 0, length = 0;
        std::string vr;  ///< empty where it is not written
    };
    void endOpened();
    bool isWhole();
    void requireRoom(std::uint32_t tag, std::size_t head_bytes, std::uint32_t length) const;
    Head head() const;
    void take();
    void takeInSequence(const Head& head);
    void takeInItem(const Head& head);
    void openSequence(std::uint64_t end, Coding coding);

    const std::uint64_t most_;
    std::uint64_t at_ = 0;    ///< behind what was taken
    std::uint64_t skip_ = 0;  ///< bytes of a value that are still to come
    std::array<unsigned char, 16> head_{};
    std::size_t head_size_ = 0, wanted_ = 8;
    HeaderCost cost_;
    std::vector<Level> open_;
    std::size_t depth_ = 0;  ///< of sequences
};

}  // namespace vicon::ingest
