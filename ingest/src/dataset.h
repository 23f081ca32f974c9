#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <optional>
#include <string>
#include <vector>

#include "text.h"
#include "vicon/core/geometry.h"

namespace vicon::ingest {

/// Elements larger than this many bytes (pixels) stay in the file when its header is read.
inline constexpr Uint32 kLargestElementInMemory = 16384;

/// A text of one line is cut after this many bytes, as it stands in the object. DICOM allows 64 characters, a name of
/// three spellings 192: what is longer was made to fill memory.
inline constexpr std::size_t kLongestText_bytes = 1024;

/// The first of an element's values; empty where it has none.
inline std::string firstOf(const std::vector<std::string>& values)
{
    return values.empty() ? std::string() : values.front();
}

/// Reads elements of a data set or item: absent and malformed ones are empty. Texts are UTF-8 without control
/// characters, see printable(); a longer one is cut, and ends with "…". An element that was written as UN is read as
/// what the dictionary says it is.
class Dataset {
public:
    /// @param outer_character_sets those of the surrounding data set, which an item inherits
    explicit Dataset(DcmItem& item, std::vector<std::string> outer_character_sets = {});

    /// A value without padding, as it stands, all values joined by backslashes: its first 64 KiB.
    std::string raw(const DcmTagKey& tag) const;
    /// The values of a code string or UID.
    std::vector<std::string> values(const DcmTagKey& tag) const;
    std::string text(const DcmTagKey& tag) const;
    /// A text of several lines, which end as in Unix.
    std::string longText(const DcmTagKey& tag) const;
    std::string personName(const DcmTagKey& tag) const;
    /// Whether more is written than text() and personName() give.
    bool isCut(const DcmTagKey& tag) const;
    /// A finite one. A decimal string may have a comma for its point; see hasDecimalComma().
    std::optional<double> number(const DcmTagKey& tag, unsigned long index = 0) const;
    /// Whether the first value of a decimal string is written with a comma.
    bool hasDecimalComma(const DcmTagKey& tag) const;
    std::optional<int> integer(const DcmTagKey& tag) const;
    bool has(const DcmTagKey& tag) const;

    /// An item of a sequence, or nothing.
    std::optional<Dataset> item(const DcmTagKey& sequence, long index = 0) const;
    unsigned long itemCount(const DcmTagKey& sequence) const;
    /// All items of a sequence, in order.
    std::vector<Dataset> items(const DcmTagKey& sequence) const;
    DcmItem& dcmItem() const { return *item_; }

private:
    std::string shown(const DcmTagKey& tag, TextKind kind) const;

    DcmItem* item_;
    std::vector<std::string> character_sets_;
};

}  // namespace vicon::ingest
