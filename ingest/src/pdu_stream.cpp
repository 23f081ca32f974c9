#include "pdu_stream.h"

#include <algorithm>

#include "element_coding.h"

namespace vicon::ingest {
namespace {

constexpr unsigned char kAcceptance = 2, kData = 4;
/// 128 contexts, each with a transfer syntax, have 10 kB.
constexpr std::uint64_t kLongestAcceptance = 1U << 17U;
constexpr std::uint32_t kContextAndFlags = 2;  // bytes of a fragment that are not its own

}  // namespace

bool PduStream::add(std::span<const unsigned char> bytes)
{
    while (!bytes.empty()) {
        const bool in_head = part_ == Part::head || part_ == Part::fragment_head;
        const std::uint64_t wanted = in_head                   ? head_.size() - head_size_
                                     : part_ == Part::fragment ? fragment_left_
                                                               : left_;
        const auto here = bytes.first(std::min<std::uint64_t>(wanted, bytes.size()));
        bytes = bytes.subspan(here.size());
        if (!in_head) {
            takeContent(here);
            continue;
        }
        std::copy(here.begin(), here.end(), head_.begin() + std::ptrdiff_t(head_size_));
        head_size_ += here.size();
        if (head_size_ < head_.size())
            continue;
        head_size_ = 0;
        if (part_ == Part::head)
            takeHead();
        else if (!takeFragmentHead())
            return false;
    }
    return true;
}

void PduStream::takeHead()
{
    left_ = numberIn(&head_[2], 4, true);
    const unsigned char kind = head_[0];
    part_ = kind == kData                                        ? Part::fragment_head
            : kind == kAcceptance && left_ <= kLongestAcceptance ? Part::acceptance
                                                                 : Part::other;
    if (left_ == 0)
        part_ = Part::head;
}

bool PduStream::takeFragmentHead()
{
    constexpr unsigned kCommand = 1, kLast = 2;
    const std::uint64_t length = numberIn(head_.data(), 4, true);
    if (left_ < head_.size() || length < kContextAndFlags || length - kContextAndFlags > left_ - head_.size())
        return false;
    left_ -= head_.size();
    fragment_ = {head_[4], (head_[5] & kCommand) != 0, (head_[5] & kLast) != 0};
    fragment_left_ = length - kContextAndFlags;
    part_ = Part::fragment;
    if (fragment_left_ == 0)
        goOn();
    return true;
}

void PduStream::takeContent(std::span<const unsigned char> bytes)
{
    left_ -= bytes.size();
    if (part_ == Part::fragment) {
        fragment_left_ -= bytes.size();
        hearer_.hearBytes(fragment_, bytes);
        if (fragment_left_ == 0)
            goOn();
        return;
    }
    if (part_ == Part::acceptance)
        acceptance_.append(bytes.begin(), bytes.end());
    if (left_ > 0)
        return;
    if (part_ == Part::acceptance)
        hearer_.hearAcceptance(acceptance_);
    acceptance_.clear();
    part_ = Part::head;
}

/// A fragment is over.
void PduStream::goOn()
{
    hearer_.hearEnd(fragment_);
    part_ = left_ > 0 ? Part::fragment_head : Part::head;
}

}  // namespace vicon::ingest
