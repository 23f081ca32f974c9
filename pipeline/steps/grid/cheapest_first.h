#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace vicon::steps {

/// A queue of numbers that wait with a cost: cheapest first, of equal costs the smaller number, so that the order is
/// always the same. A heap of four children a node: flatter than std::priority_queue's, and siblings share a cache
/// line.
class CheapestFirst {
public:
    /// @param cost at least 0; so its bits order as it does
    void push(float cost, std::uint32_t number)
    {
        const std::uint64_t key = std::uint64_t(std::bit_cast<std::uint32_t>(cost)) << 32 | number;
        std::size_t at = keys_.size();
        keys_.push_back(key);
        for (; at > 0 && key < keys_[(at - 1) / kChildren]; at = (at - 1) / kChildren)
            keys_[at] = keys_[(at - 1) / kChildren];
        keys_[at] = key;
    }

    /// Takes the cheapest out: its cost and its number.
    std::pair<float, std::uint32_t> pop()
    {
        const std::uint64_t top = keys_.front(), last = keys_.back();
        keys_.pop_back();
        if (!keys_.empty())
            sink(last);
        return {std::bit_cast<float>(std::uint32_t(top >> 32)), std::uint32_t(top)};
    }

    bool empty() const { return keys_.empty(); }
    /// The number that comes next, if nothing cheaper is pushed before.
    std::uint32_t next() const { return std::uint32_t(keys_.front()); }
    /// Calls use(number) for those of which one comes after that.
    template <class Use>
    void forEachBehindNext(Use use) const
    {
        for (std::size_t n = 1; n < std::min(keys_.size(), 1 + kChildren); ++n)
            use(std::uint32_t(keys_[n]));
    }

private:
    static constexpr std::size_t kChildren = 4;

    /// Puts a key at the top and lets it down to its place.
    void sink(std::uint64_t key)
    {
        std::size_t at = 0;
        for (std::size_t child = 1; child < keys_.size(); child = kChildren * at + 1) {
            std::size_t least = child;
            for (std::size_t n = child + 1; n < std::min(child + kChildren, keys_.size()); ++n)
                least = keys_[n] < keys_[least] ? n : least;
            if (keys_[least] >= key)
                break;
            keys_[at] = keys_[least];
            at = least;
        }
        keys_[at] = key;
    }

    std::vector<std::uint64_t> keys_;
};

}  // namespace vicon::steps
