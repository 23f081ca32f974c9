#include "element_stream.h"

#include <algorithm>
#include <utility>

#include "structure_scan.h"

namespace vicon::ingest {
namespace {

constexpr std::size_t kShortHead = 8, kLongHead = 12, kItemHead = 8;

struct NotFollowed {
    std::string why;
};

void stayWithin(std::string too_much)
{
    if (!too_much.empty())
        throw NotFollowed{std::move(too_much)};
}

}  // namespace

ElementStream::ElementStream(Coding coding, std::uint64_t most_bytes)
    : most_(most_bytes), open_{{kOpenEnd, false, coding}}
{
}

std::string ElementStream::add(std::span<const unsigned char> bytes)
try {
    while (!bytes.empty()) {
        if (skip_ > 0) {
            const std::uint64_t here = std::min<std::uint64_t>(skip_, bytes.size());
            skip_ -= here;
            bytes = bytes.subspan(here);
            continue;
        }
        const std::size_t here = std::min(wanted_ - head_size_, bytes.size());
        std::copy_n(bytes.begin(), here, head_.begin() + std::ptrdiff_t(head_size_));
        head_size_ += here;
        bytes = bytes.subspan(here);
        if (head_size_ == wanted_ && isWhole())
            take();
    }
    return {};
} catch (NotFollowed& refused) {
    return std::move(refused.why);
}

/// Whether the bytes of the element's head are all there; else more are wanted. Those of a value that may be a sequence
/// belong to it: where no type is written, its first bytes tell.
bool ElementStream::isWhole()
{
    endOpened();
    const Coding coding = open_.back().coding;
    const std::uint32_t tag = tagIn(head_.data(), coding.big_endian);
    if (head_size_ == kShortHead && tag >> 16 != kDelimiterGroup && !open_.back().sequence) {
        const std::string vr{char(head_[4]), char(head_[5])};
        if (coding.explicit_vr && isTypeOf(kLongVrs, vr)) {
            wanted_ = kLongHead;
            return false;
        }
        if (coding.explicit_vr && !isTypeOf(kShortVrs, vr))
            throw NotFollowed{tagName(tag) + " has a type that is none"};
        const std::uint32_t length = numberIn(&head_[4], 4, coding.big_endian);
        if (!coding.explicit_vr && length != kUndefinedLength && length > 0) {
            requireRoom(tag, kShortHead, length);  // at once: a library makes room for the value when it knows this
            wanted_ = kShortHead + std::min<std::size_t>(length, kItemHead);
            return false;
        }
    }
    return true;
}

void ElementStream::requireRoom(std::uint32_t tag, std::size_t head_bytes, std::uint32_t length) const
{
    const std::uint64_t end = std::min(open_.back().end, most_);
    if (at_ + head_bytes > end || length > end - at_ - head_bytes)
        throw NotFollowed{tagName(tag) + " should have " + std::to_string(length) + " bytes, more than may be"};
}

/// Sequences and items that say their length end without a word.
void ElementStream::endOpened()
{
    while (open_.back().end != kOpenEnd && at_ >= open_.back().end) {
        if (at_ > open_.back().end)
            throw NotFollowed{"an element reaches beyond its item"};
        depth_ -= open_.back().sequence ? 1 : 0;
        open_.pop_back();
    }
}

ElementStream::Head ElementStream::head() const
{
    const Coding coding = open_.back().coding;
    Head head{tagIn(head_.data(), coding.big_endian), 0, {}};
    if (!coding.explicit_vr || head.tag >> 16 == kDelimiterGroup || open_.back().sequence) {
        head.length = numberIn(&head_[4], 4, coding.big_endian);
        return head;
    }
    head.vr = {char(head_[4]), char(head_[5])};
    head.length =
        wanted_ == kLongHead ? numberIn(&head_[8], 4, coding.big_endian) : numberIn(&head_[6], 2, coding.big_endian);
    return head;
}

void ElementStream::take()
{
    const Head taken = head();
    const std::size_t size = wanted_ == kLongHead && open_.back().coding.explicit_vr ? kLongHead : kShortHead;
    requireRoom(taken.tag, size, taken.length == kUndefinedLength ? 0 : taken.length);
    at_ += size;
    const std::size_t looked_at = wanted_ - size;  // of the value
    std::array<unsigned char, kItemHead> beginning{};
    std::copy_n(head_.begin() + std::ptrdiff_t(size), looked_at, beginning.begin());
    head_size_ = 0;
    wanted_ = kShortHead;
    open_.back().sequence ? takeInSequence(taken) : takeInItem(taken);
    if (looked_at == 0)
        return;
    if (skip_ == 0) {  // what was looked at is the head of the first item
        std::copy(beginning.begin(), beginning.end(), head_.begin());
        head_size_ = looked_at;
        if (isWhole())
            take();
        return;
    }
    skip_ -= looked_at;
}

void ElementStream::takeInSequence(const Head& head)
{
    const Level top = open_.back();
    stayWithin(cost_.addPart());
    if (head.tag == kSequenceEnd && top.end == kOpenEnd) {
        open_.pop_back();
        --depth_;
        return;
    }
    if (head.tag != kItem)
        throw NotFollowed{"a sequence holds " + tagName(head.tag)};
    open_.push_back({head.length == kUndefinedLength ? kOpenEnd : at_ + head.length, false, top.coding});
}

void ElementStream::takeInItem(const Head& head)
{
    const Coding coding = open_.back().coding;
    if (head.tag == kItemEnd && open_.back().end == kOpenEnd && open_.size() > 1) {
        open_.pop_back();
        return;
    }
    if (head.tag >> 16 == kDelimiterGroup)
        throw NotFollowed{"an item holds " + tagName(head.tag)};
    const bool is_open = head.length == kUndefinedLength;
    const bool nests =
        is_open || head.vr == "SQ" ||
        (head.vr.empty() && head.length >= kItemHead && tagIn(&head_[kShortHead], coding.big_endian) == kItem);
    const std::size_t looked_at = is_open ? 0 : std::min<std::size_t>(head.length, kItemHead);
    if (head.vr.empty() && mayEndElsewhere(head.tag, &head_[kShortHead], looked_at))
        throw NotFollowed{tagName(head.tag) + " holds a sequence that ends within itself"};
    stayWithin(cost_.addElement(open_.back().tally, head.tag, nests ? 0 : head.length));
    if (head.tag == kRecordType && head.length > kLongestCode)
        throw NotFollowed{tagName(head.tag) + " has " + std::to_string(head.length) + " bytes, more than may be"};
    if (is_open && !head.vr.empty() && head.vr != "SQ" && head.vr != "UN")
        throw NotFollowed{tagName(head.tag) + " has no length"};
    if (!nests) {
        skip_ = head.length;
        at_ += head.length;
    } else if (is_open || head.length > 0) {
        openSequence(is_open ? kOpenEnd : at_ + head.length, head.vr == "UN" ? Coding{false, false} : coding);
    }
}

void ElementStream::openSequence(std::uint64_t end, Coding coding)
{
    open_.push_back({end, true, coding});
    if (++depth_ > std::size_t(kDeepestSequence))
        throw NotFollowed{"its sequences are nested deeper than " + std::to_string(kDeepestSequence)};
}

}  // namespace vicon::ingest
