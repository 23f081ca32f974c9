#pragma once

#include <algorithm>
#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace vicon::steps {

/// A cost of at least 0 and a number in 64 bits: the bits of such a cost order as it does.
class PackedCost {
public:
    PackedCost(float cost, std::uint32_t number)
        : bits_(std::uint64_t(std::bit_cast<std::uint32_t>(cost)) << 32 | number)
    {
    }
    float cost() const { return std::bit_cast<float>(std::uint32_t(bits_ >> 32)); }
    std::uint32_t number() const { return std::uint32_t(bits_); }
    friend auto operator<=>(PackedCost, PackedCost) = default;

private:
    std::uint64_t bits_;
};

/// Any cost and a number.
class WideCost {
public:
    WideCost(double cost, std::uint32_t number) : cost_(cost), number_(number) {}
    double cost() const { return cost_; }
    std::uint32_t number() const { return number_; }
    friend auto operator<=>(WideCost, WideCost) = default;

private:
    double cost_;
    std::uint32_t number_;
};

/// A queue of numbers that wait with a cost: cheapest first, of equal costs the smaller number, so that the order is
/// always the same. A heap of four children a node: flatter than std::priority_queue's, and siblings share a cache
/// line.
template <class Waiting>
class CostQueue {
public:
    using Cost = decltype(std::declval<Waiting>().cost());

    void push(Cost cost, std::uint32_t number)
    {
        const Waiting key(cost, number);
        std::size_t at = keys_.size();
        keys_.push_back(key);
        for (; at > 0 && key < keys_[(at - 1) / kChildren]; at = (at - 1) / kChildren)
            keys_[at] = keys_[(at - 1) / kChildren];
        keys_[at] = key;
    }

    /// Takes the cheapest out: its cost and its number.
    std::pair<Cost, std::uint32_t> pop()
    {
        const Waiting top = keys_.front(), last = keys_.back();
        keys_.pop_back();
        if (!keys_.empty())
            sink(last);
        return {top.cost(), top.number()};
    }

    bool empty() const { return keys_.empty(); }
    void clear() { keys_.clear(); }
    /// The number that comes next, if nothing cheaper is pushed before.
    std::uint32_t next() const { return keys_.front().number(); }
    /// Calls use(number) for those of which one comes after that.
    template <class Use>
    void forEachBehindNext(Use use) const
    {
        for (std::size_t n = 1; n < std::min(keys_.size(), 1 + kChildren); ++n)
            use(keys_[n].number());
    }

private:
    static constexpr std::size_t kChildren = 4;  // of a node of the heap: siblings lie in one cache line

    /// Puts a key at the top and lets it down to its place.
    void sink(Waiting key)
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

    std::vector<Waiting> keys_;
};

/// Half the memory: for fronts through a whole lumen.
using CheapestFirst = CostQueue<PackedCost>;
/// For costs in double precision, or below 0.
using CheapestFirstWide = CostQueue<WideCost>;

}  // namespace vicon::steps
