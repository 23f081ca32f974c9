#include "free_space.h"

#include <algorithm>
#include <cstdint>

namespace vicon::viewer {
namespace {

constexpr double kLeastStep_mm = 0.1;
constexpr std::int32_t kUnseen = -1, kBlocked = -2;
// Geometry: from a voxel to its six neighbours.
constexpr int kFaceSteps[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

/// A cube of places a voxel apart around a point; each knows the one that it was reached from.
class Lattice {
public:
    Lattice(Point3 middle, double step_mm, double reach_mm)
        : middle_(middle),
          step_mm_(step_mm),
          reach_(int(reach_mm / step_mm)),
          side_(2 * reach_ + 1),
          from_(std::size_t(side_) * std::size_t(side_) * std::size_t(side_), kUnseen)
    {
    }

    std::int32_t middle() const { return numberOf(reach_, reach_, reach_); }
    Point3 at(std::int32_t n) const
    {
        const int i = n % side_ - reach_, j = n / side_ % side_ - reach_, k = n / side_ / side_ - reach_;
        return middle_ + Vector3{double(i), double(j), double(k)} * step_mm_;
    }
    /// The place nearest to `p`; negative outside.
    std::int32_t nearest(Point3 p) const
    {
        const Vector3 d = (p - middle_) / step_mm_;
        const int i = int(std::lround(d.x)) + reach_, j = int(std::lround(d.y)) + reach_,
                  k = int(std::lround(d.z)) + reach_;
        return std::min({i, j, k}) < 0 || std::max({i, j, k}) >= side_ ? -1 : numberOf(i, j, k);
    }
    std::int32_t neighbour(std::int32_t n, const int (&move)[3]) const
    {
        const int i = n % side_ + move[0], j = n / side_ % side_ + move[1], k = n / side_ / side_ + move[2];
        return std::min({i, j, k}) < 0 || std::max({i, j, k}) >= side_ ? -1 : numberOf(i, j, k);
    }
    std::int32_t& reachedFrom(std::int32_t n) { return from_[std::size_t(n)]; }

private:
    std::int32_t numberOf(int i, int j, int k) const { return (k * side_ + j) * side_ + i; }

    Point3 middle_;
    double step_mm_;
    int reach_, side_;
    std::vector<std::int32_t> from_;
};

std::vector<Point3> backFrom(Lattice& lattice, std::int32_t last, Point3 goal)
{
    std::vector<Point3> places{goal};
    for (std::int32_t n = last; n != lattice.middle(); n = lattice.reachedFrom(n))
        places.push_back(lattice.at(n));
    return places;
}

}  // namespace

bool FreeSpace::straightWay(Point3 from, Point3 to) const
{
    const double whole = distance(from, to);
    const Vector3 direction = whole > 0 ? (to - from) / whole : Vector3{};
    for (double at = 0; at < whole;) {
        const Point3 p = from + direction * at;
        if (!holds(p))
            return false;
        at += std::max(kLeastStep_mm, lumen_.clearance_mm(p) - least_mm_ - lumen_.halfDiagonal_mm());
    }
    return holds(to);
}

Point3 FreeSpace::moved(Point3 from, Vector3& velocity_mm_s, double seconds) const
{
    Vector3 move = velocity_mm_s * seconds;
    if (length(move) > kMostStep_mm)
        move = normalized(move) * kMostStep_mm;
    if (holds(from + move))
        return from + move;
    const Vector3 off_wall = normalized(lumen_.clearanceGradient(from));
    const auto slid = [&](Vector3 v) { return v - off_wall * std::min(0.0, dot(v, off_wall)); };
    Point3 next = from + slid(move);
    next += off_wall * std::max(0.0, least_mm() + 1e-3 - lumen_.clearance_mm(next));
    velocity_mm_s = slid(velocity_mm_s);
    return holds(next) && distance(next, from) <= 2 * kMostStep_mm ? next : from;
}

FreeSpace::Way FreeSpace::wayTo(const std::vector<Point3>& goals, Point3 from, double reach_mm) const
{
    Lattice lattice(from, lumen_.voxel_mm(), reach_mm);
    std::vector<std::pair<std::int32_t, std::size_t>> ends;  // places beside the goals
    for (std::size_t g = 0; g < goals.size(); ++g)
        if (const std::int32_t n = lattice.nearest(goals[g]); n >= 0 && straightWay(lattice.at(n), goals[g]))
            ends.emplace_back(n, g);
    std::sort(ends.begin(), ends.end());
    std::vector<std::int32_t> front{lattice.middle()};
    lattice.reachedFrom(lattice.middle()) = lattice.middle();
    for (std::size_t next = 0; next < front.size(); ++next) {
        const std::int32_t here = front[next];
        const auto end = std::lower_bound(ends.begin(), ends.end(), std::pair{here, std::size_t{0}});
        if (end != ends.end() && end->first == here)
            return {backFrom(lattice, here, goals[end->second]), end->second};
        for (const auto& move : kFaceSteps) {
            const std::int32_t there = lattice.neighbour(here, move);
            if (there < 0 || lattice.reachedFrom(there) != kUnseen)
                continue;
            const bool free = holds(lattice.at(there));
            lattice.reachedFrom(there) = free ? here : kBlocked;
            if (free)
                front.push_back(there);
        }
    }
    return {};
}

}  // namespace vicon::viewer
