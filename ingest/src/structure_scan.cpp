#include "structure_scan.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

#include "deflated_size.h"
#include "element_coding.h"
#include "element_source.h"
#include "header_cost.h"

namespace vicon::ingest {
namespace {

using Fate = Structure::Fate;

constexpr std::uint32_t kMetaLength = 0x00020000, kTransferSyntax = 0x00020010, kPixelData = 0x7fe00010;
constexpr std::uint64_t kPreamble = 128, kHead = 132;

struct Element {
    std::uint32_t tag = 0, length = 0;
    std::string vr;  ///< empty where it is not written
    std::uint64_t value_at = 0;
};

/// A place that holds elements or items.
struct Open {
    std::uint64_t end = kOpenEnd;
    bool sequence = false;
    Coding coding;
    ItemTally tally{};
};

/// Ends the walk with what it found.
struct Ended {
    Structure found;
};

[[noreturn]] void refuse(std::string why, bool clear_until_pixels = false)
{
    throw Ended{{Fate::refused, std::move(why), 0, clear_until_pixels, {}}};
}

[[noreturn]] void odd(std::uint64_t trailing_bytes = 0)
{
    throw Ended{{Fate::odd, {}, trailing_bytes, false, {}}};
}

class Walk {
public:
    explicit Walk(ElementSource& source) : source_(source) {}

    /// Returns the transfer syntax.
    std::string run()
    {
        const unsigned char* magic = source_.at(kPreamble, 4);
        if (!magic || std::memcmp(magic, "DICM", 4) != 0)
            withoutHead();
        at_ = kHead;
        readMeta();
        if (isDeflated(syntax_)) {
            if (deflatedSize(source_, at_, kLargestDeflated) > kLargestDeflated)
                refuse("its deflated data set fills more than " + std::to_string(kLargestDeflated / 1000000) + " MB");
            odd();
        }
        const auto coding = codingOf(syntax_);
        if (!coding || !meta_is_plain_)
            odd();
        open_.push_back({source_.size(), false, *coding});
        while (!open_.empty())
            step();
        return syntax_;
    }

private:
    /// Without preamble and meta header a data set begins with one of the first groups, in whichever byte order.
    void withoutHead()
    {
        constexpr unsigned kLastGroup = 0x28;
        const unsigned char* tag = source_.at(0, 8);
        const bool little = tag && tag[1] == 0 && tag[0] > 0 && tag[0] <= kLastGroup;
        const bool big = tag && tag[0] == 0 && tag[1] > 0 && tag[1] <= kLastGroup;
        if (!little && !big)
            refuse("no DICOM file, or damaged beyond reading");
        odd();
    }

    std::uint32_t number(std::uint64_t place, std::size_t count, bool big_endian)
    {
        const unsigned char* bytes = source_.at(place, count);
        return bytes ? numberIn(bytes, count, big_endian) : 0;
    }

    std::uint32_t tagAt(std::uint64_t place, bool big_endian)
    {
        return number(place, 2, big_endian) << 16 | number(place + 2, 2, big_endian);
    }

    /// The element at `at_`; nothing where none can be.
    std::optional<Element> element(const Coding& coding)
    {
        if (!source_.at(at_, 8))
            return {};
        Element e;
        e.tag = tagAt(at_, coding.big_endian);
        if (!coding.explicit_vr || e.tag >> 16 == kDelimiterGroup) {
            e.length = number(at_ + 4, 4, coding.big_endian);
            e.value_at = at_ + 8;
            return e;
        }
        const unsigned char* vr = source_.at(at_ + 4, 2);
        e.vr = {char(vr[0]), char(vr[1])};
        if (isTypeOf(kShortVrs, e.vr)) {
            e.length = number(at_ + 6, 2, coding.big_endian);
            e.value_at = at_ + 8;
            return e;
        }
        if (!isTypeOf(kLongVrs, e.vr) || !source_.at(at_, 12))
            return {};
        e.length = number(at_ + 8, 4, coding.big_endian);
        e.value_at = at_ + 12;
        return e;
    }

    static void stayWithin(const std::string& too_much)
    {
        if (!too_much.empty())
            refuse(too_much);
    }

    /// Where the data set begins, and its transfer syntax. A library may see both elsewhere unless the length of the
    /// meta header stands first and leads to its end, no element of it holds others, and the syntax is said once.
    void readMeta()
    {
        ItemTally meta;
        std::uint64_t end = 0;
        while (number(at_, 2, false) == 0x0002) {
            const auto e = element({});
            if (!e)
                refuse("truncated or damaged (its meta header breaks off at " + tagName(tagAt(at_, false)) + ")");
            stayWithin(cost_.addElement(meta, e->tag, e->length));
            mustFit(*e);
            const bool is_length = e->tag == kMetaLength && e->vr == "UL" && e->length == 4;
            if (meta.elements == 1 && is_length)
                end = e->value_at + e->length + number(e->value_at, 4, false);
            if (e->tag == kTransferSyntax)
                readSyntax(*e);
            meta_is_plain_ = meta_is_plain_ && e->vr != "SQ" && e->vr != "UN";
            at_ = e->value_at + e->length;
        }
        meta_is_plain_ = meta_is_plain_ && at_ == end;
    }

    void readSyntax(const Element& e)
    {
        constexpr std::size_t kLongestUid = 64;
        meta_is_plain_ = meta_is_plain_ && syntax_.empty() && e.vr == "UI" && e.length <= kLongestUid;
        if (e.length == 0 || e.length > kLongestUid)
            return;
        const unsigned char* uid = source_.at(e.value_at, e.length);
        syntax_.assign(reinterpret_cast<const char*>(uid), e.length);
        syntax_.erase(syntax_.find_last_not_of(std::string_view(" \0", 2)) + 1);
    }

    void mustFit(const Element& e)
    {
        const std::uint64_t left = source_.size() - e.value_at;
        if (e.length > left)
            refuse("truncated or damaged (" + tagName(e.tag) + " should have " + std::to_string(e.length) + " bytes, " +
                       std::to_string(left) + " are there)",
                   in_pixels_);
    }

    void step()
    {
        Open& top = open_.back();
        if (top.end != kOpenEnd && at_ >= top.end) {
            if (at_ > top.end)
                odd();
            open_.pop_back();
            return;
        }
        if (top.sequence)
            stepInSequence();
        else
            stepInItem();
    }

    void stepInSequence()
    {
        const Open top = open_.back();
        stayWithin(cost_.addPart());
        const auto e = element(top.coding);
        if (!e)
            refuse("truncated or damaged (a sequence breaks off)");
        at_ = e->value_at;
        if (e->tag == kSequenceEnd && top.end == kOpenEnd) {
            open_.pop_back();
            return;
        }
        if (e->tag != kItem)
            odd();
        if (e->length != kUndefinedLength)
            mustFit(*e);
        open_.push_back({e->length == kUndefinedLength ? kOpenEnd : at_ + e->length, false, top.coding});
    }

    void stepInItem()
    {
        const Open top = open_.back();
        const bool outermost = open_.size() == 1;
        const auto e = element(top.coding);
        const bool behind_pixels = outermost && after_pixels_ && (!e || e->tag <= kPixelData);
        if (behind_pixels || (outermost && after_pixels_ && e->length != kUndefinedLength && !fits(*e)))
            odd(source_.size() - at_);
        if (!e && source_.size() - at_ < 8)
            refuse("truncated or damaged (it breaks off within an element)");
        if (!e)
            odd();
        if (e->tag == kItemEnd && top.end == kOpenEnd) {
            at_ = e->value_at;
            open_.pop_back();
            return;
        }
        if (e->tag >> 16 == kDelimiterGroup)
            odd();
        in_pixels_ = outermost && e->tag == kPixelData;
        stayWithin(cost_.addElement(open_.back().tally, e->tag, ownBytes(*e)));
        take(*e, top.coding);
        in_pixels_ = false;
        after_pixels_ = after_pixels_ || (outermost && e->tag == kPixelData);
    }

    bool fits(const Element& e) const { return e.length <= source_.size() - e.value_at; }

    /// Those of the header that are not elements of items again.
    std::uint64_t ownBytes(const Element& e)
    {
        return in_pixels_ || e.length == kUndefinedLength || isSequence(e, open_.back().coding) ? 0 : e.length;
    }

    bool isSequence(const Element& e, const Coding& coding)
    {
        return e.vr == "SQ" || (e.vr.empty() && e.length >= 8 && tagAt(e.value_at, coding.big_endian) == kItem);
    }

    void take(const Element& e, const Coding& coding)
    {
        const bool in_fragments = e.vr.empty() || e.vr == "OB" || e.vr == "OW";
        if (e.length == kUndefinedLength && e.tag == kPixelData && in_fragments)
            return skipFragments(e, coding);
        at_ = e.value_at;
        if (e.length == kUndefinedLength) {
            if (!e.vr.empty() && e.vr != "SQ" && e.vr != "UN")
                odd();
            const Coding inside = e.vr == "UN" ? Coding{false, false} : coding;
            return openSequence(kOpenEnd, inside);
        }
        mustFit(e);
        if (e.tag == kRecordType && e.length > kLongestCode)
            refuse("truncated or damaged (" + tagName(e.tag) + " has " + std::to_string(e.length) + " bytes, " +
                   std::to_string(kLongestCode) + " at most are allowed)");
        if (e.vr.empty() && mayEndElsewhere(e))
            odd();
        if (isSequence(e, coding) && e.length > 0)
            openSequence(at_ + e.length, coding);
        else
            at_ += e.length;
    }

    bool mayEndElsewhere(const Element& e)
    {
        const std::size_t count = std::min<std::size_t>(e.length, 8);
        const unsigned char* begin = source_.at(e.value_at, count);
        return begin && ingest::mayEndElsewhere(e.tag, begin, count);
    }

    void openSequence(std::uint64_t end, const Coding& coding)
    {
        open_.push_back({end, true, coding});
        const auto depth = std::count_if(open_.begin(), open_.end(), [](const Open& open) { return open.sequence; });
        if (depth > kDeepestSequence)
            refuse("its sequences are nested deeper than " + std::to_string(kDeepestSequence));
    }

    void skipFragments(const Element& pixels, const Coding& coding)
    {
        at_ = pixels.value_at;
        for (;;) {
            stayWithin(cost_.addPart());
            if (!source_.at(at_, 8))
                refuse("truncated or damaged (its compressed pixels are cut off)", in_pixels_);
            const Element e{tagAt(at_, coding.big_endian), number(at_ + 4, 4, coding.big_endian), {}, at_ + 8};
            if (e.tag == kSequenceEnd) {
                at_ = e.value_at;
                return;
            }
            if (e.tag != kItem || e.length == kUndefinedLength)
                odd();
            mustFit(e);
            at_ = e.value_at + e.length;
        }
    }

    ElementSource& source_;
    std::uint64_t at_ = 0;
    HeaderCost cost_;
    std::string syntax_;
    bool meta_is_plain_ = true;
    std::vector<Open> open_;
    bool in_pixels_ = false;  ///< those of the data set itself
    bool after_pixels_ = false;
};

}  // namespace

Structure scanStructure(const std::filesystem::path& file)
{
    ElementSource source(file);
    std::string transfer_syntax;
    try {
        if (source.error() == 0)
            transfer_syntax = Walk(source).run();
    } catch (const Ended& ended) {
        if (source.error() == 0)
            return ended.found;
    }
    if (source.error() != 0)
        return {Fate::refused, "cannot be read (" + std::string(std::strerror(source.error())) + ")", 0, false, {}};
    return {Fate::clear, {}, 0, false, transfer_syntax};
}

}  // namespace vicon::ingest
