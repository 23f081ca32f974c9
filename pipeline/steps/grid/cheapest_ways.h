#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "grid/cheapest_first.h"

namespace vicon::steps {

/// Runs a front over a graph, the cheapest node first (Dijkstra): hands each node that comes out of the queue to
/// visit(number, cost), which pushes those that can be reached from it and says whether the front goes on. A node that
/// was reached at a lower cost since it was pushed, known(number), is passed over.
template <class Queue, class Known, class Visit>
void runFront(Queue& queue, Known known, Visit visit)
{
    while (!queue.empty()) {
        const auto [cost, number] = queue.pop();
        if (cost > known(number))
            continue;
        if (!visit(number, cost))
            return;
    }
}

/// The cheapest ways from one node of a graph to others.
template <class Queue>
class CheapestWays {
public:
    using Cost = typename Queue::Cost;
    static constexpr Cost kUnreached = std::numeric_limits<Cost>::infinity();  ///< no way leads there

    /// @param count nodes, numbered from 0 on
    CheapestWays(std::size_t count, std::size_t start) : nodes_(count)
    {
        nodes_[start].cost = 0;
        queue_.push(0, std::uint32_t(start));
    }

    /// Runs the front until isOver(number, cost) of the node at work, or until all is reached. `edges` calls its last
    /// argument with each neighbour's number and what the step there costs.
    template <class IsOver, class Edges>
    void run(IsOver isOver, Edges edges)
    {
        const auto known = [&](std::uint32_t n) { return nodes_[n].cost; };
        runFront(queue_, known, [&](std::uint32_t n, Cost so_far) {
            if (isOver(n, so_far))
                return false;
            edges(n, [&](std::size_t m, Cost step) { offer(m, so_far + step, n); });
            return true;
        });
    }

    Cost costOf(std::size_t n) const { return nodes_[n].cost; }
    bool reaches(std::size_t n) const { return nodes_[n].cost < kUnreached; }
    /// From the start to a node that was reached, both included.
    std::vector<std::size_t> wayTo(std::size_t n) const
    {
        std::vector<std::size_t> way{n};
        while (nodes_[way.back()].before != kNone)
            way.push_back(nodes_[way.back()].before);
        std::reverse(way.begin(), way.end());
        return way;
    }

private:
    static constexpr auto kNone = ~std::uint32_t(0);  // no node
    struct Node {
        Cost cost = kUnreached;
        std::uint32_t before = kNone;
    };

    void offer(std::size_t n, Cost cost, std::uint32_t before)
    {
        if (cost >= nodes_[n].cost)
            return;
        nodes_[n] = {cost, before};
        queue_.push(cost, std::uint32_t(n));
    }

    std::vector<Node> nodes_;
    Queue queue_;
};

}  // namespace vicon::steps
