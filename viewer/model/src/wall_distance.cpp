#include "vicon/viewer/model/wall_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <unordered_map>

#include "nearest_on_triangle.h"

namespace vicon::viewer {
namespace {

constexpr int kOnEdge = 6;  // places between the ends of an edge
constexpr double kLeastReach_mm = 15, kMostReach_mm = 400;

/// The triangles within a ball, with places on their edges as the nodes of a graph: two nodes are joined where they lie
/// on the same triangle.
class NearSurface {
public:
    /// Every function throws Error{cancelled} where `wanted` is no longer; nothing: it always is.
    NearSurface(const std::vector<float>& points_mm, const std::vector<std::uint32_t>& triangles, Point3 centre,
                double reach, const Progress* wanted)
        : points_(points_mm), wanted_(wanted)
    {
        for (std::size_t n = 0; n + 2 < triangles.size(); n += 3) {
            checkAt(n);
            if (distance(point(triangles[n]), centre) < reach)
                addTriangle({triangles[n], triangles[n + 1], triangles[n + 2]});
        }
    }

    bool empty() const { return corners_.empty(); }

    /// Puts a node on the surface where it is nearest to p.
    std::size_t attach(Point3 p)
    {
        double least = std::numeric_limits<double>::max();
        std::size_t on = 0;
        Point3 foot;
        for (std::size_t t = 0; t < corners_.size(); ++t) {
            checkAt(t);
            const auto& c = corners_[t];
            const Point3 q = nearestOnTriangle(p, at_[c[0]], at_[c[1]], at_[c[2]]);
            if (const double d = distance(p, q); d < least)
                least = d, on = t, foot = q;
        }
        const std::size_t node = addNode(foot);
        addTo(on, node);
        return node;
    }

    std::vector<Point3> shortestWay(std::size_t from, std::size_t to, double& length_mm) const
    {
        std::vector<double> way(at_.size(), std::numeric_limits<double>::max());
        std::vector<std::size_t> before(at_.size(), from);
        using Entry = std::pair<double, std::size_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
        way[from] = 0;
        front.emplace(0, from);
        for (std::size_t n = 0; !front.empty() && front.top().second != to; ++n) {
            checkAt(n);
            const auto [so_far, node] = front.top();
            front.pop();
            if (so_far > way[node])
                continue;
            for (const std::size_t triangle : triangles_of_[node])
                for (const std::size_t next : nodes_of_[triangle])
                    if (const double length = so_far + distance(at_[node], at_[next]); length < way[next]) {
                        way[next] = length;
                        before[next] = node;
                        front.emplace(length, next);
                    }
        }
        length_mm = way[to];
        if (front.empty())
            return {};
        std::vector<Point3> points{at_[to]};
        for (std::size_t node = to; node != from; node = before[node])
            points.push_back(at_[before[node]]);
        std::reverse(points.begin(), points.end());
        return points;
    }

    Point3 at(std::size_t node) const { return at_[node]; }

private:
    void checkAt(std::size_t n) const
    {
        constexpr std::size_t kSome = 1024;  // a millisecond of the slowest loop
        if (wanted_ && n % kSome == 0)
            wanted_->check();
    }

    Point3 point(std::uint32_t n) const
    {
        const std::size_t at = std::size_t{3} * n;
        return {points_[at], points_[at + 1], points_[at + 2]};
    }

    std::size_t addNode(Point3 p)
    {
        at_.push_back(p);
        triangles_of_.emplace_back();
        return at_.size() - 1;
    }

    void addTo(std::size_t triangle, std::size_t node)
    {
        nodes_of_[triangle].push_back(node);
        triangles_of_[node].push_back(triangle);
    }

    void addTriangle(std::array<std::uint32_t, 3> numbers)
    {
        const std::size_t triangle = corners_.size();
        nodes_of_.emplace_back();
        std::array<std::size_t, 3> corner{};
        for (std::size_t n = 0; n < 3; ++n) {
            const auto [entry, is_new] = corner_.try_emplace(numbers[n], at_.size());
            if (is_new)
                addNode(point(numbers[n]));
            corner[n] = entry->second;
            addTo(triangle, corner[n]);
        }
        corners_.push_back(corner);
        for (std::size_t n = 0; n < 3; ++n)
            for (const std::size_t node : onEdge(numbers[n], numbers[(n + 1) % 3]))
                addTo(triangle, node);
    }

    const std::array<std::size_t, kOnEdge>& onEdge(std::uint32_t a, std::uint32_t b)
    {
        const auto low = std::min(a, b), high = std::max(a, b);
        const auto [entry, is_new] = edge_.try_emplace(std::uint64_t{high} << 32U | low);
        if (is_new)
            for (std::size_t n = 0; n < kOnEdge; ++n)
                entry->second[n] = addNode(interpolate(point(low), point(high), double(n + 1) / (kOnEdge + 1)));
        return entry->second;
    }

    const std::vector<float>& points_;
    const Progress* wanted_;
    std::vector<Point3> at_;                              // of the nodes
    std::vector<std::vector<std::size_t>> triangles_of_;  // a node
    std::vector<std::vector<std::size_t>> nodes_of_;      // a triangle
    std::vector<std::array<std::size_t, 3>> corners_;     // of the triangles
    std::unordered_map<std::uint32_t, std::size_t> corner_;
    std::unordered_map<std::uint64_t, std::array<std::size_t, kOnEdge>> edge_;
};

}  // namespace

std::optional<WallDistance> distanceOverWall(const std::vector<float>& points_mm,
                                             const std::vector<std::uint32_t>& triangles, Point3 from, Point3 to,
                                             const Progress* wanted)
{
    const Point3 middle = interpolate(from, to, 0.5);
    double reach_mm = std::max(kLeastReach_mm, distance(from, to));
    while (reach_mm <= kMostReach_mm) {
        NearSurface patch(points_mm, triangles, middle, reach_mm, wanted);
        double along_mm = std::numeric_limits<double>::max();
        if (!patch.empty()) {
            const std::size_t first = patch.attach(from), last = patch.attach(to);
            const auto way = patch.shortestWay(first, last, along_mm);
            // Every point of a way as long lies within half its length of the middle: none outside is shorter.
            if (!way.empty() && along_mm / 2 + distance(patch.at(first), from) < reach_mm)
                return WallDistance{distance(patch.at(first), patch.at(last)), along_mm, way};
        }
        reach_mm = std::max(2 * reach_mm, along_mm < kMostReach_mm ? along_mm / 2 + kLeastReach_mm : 0.0);
    }
    return std::nullopt;
}

}  // namespace vicon::viewer
