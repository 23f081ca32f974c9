#include "even_out.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace vicon::viewer {
namespace {

struct Round {
    const std::vector<float>& wanted;
    float hold, over;
};

/// A round of Jacobi's method with Chebyshev's acceleration.
/// @param before the values of the round before; the next ones afterwards
void jacobi(const SurfaceNeighbors& neighbors, std::size_t k, const Round& round, const std::vector<float>& values,
            std::vector<float>& before)
{
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, neighbors.pointCount(), 8192), [&](const auto& some) {
        for (std::size_t p = some.begin(); p < some.end(); ++p) {
            const auto count = float(neighbors.end(p) - neighbors.begin(p));
            for (std::size_t c = 0; c < k && count > 0; ++c) {
                float sum = round.hold * count * round.wanted[k * p + c];
                for (const std::uint32_t* n = neighbors.begin(p); n != neighbors.end(p); ++n)
                    sum += values[k * *n + c];
                float& next = before[k * p + c];
                next += round.over * (sum / (count * (1 + round.hold)) - next);
            }
        }
    });
}

}  // namespace

SurfaceNeighbors::SurfaceNeighbors(const CellSurface& surface) : first_(surface.pointCount() + 1, 0)
{
    // Each edge of a closed surface belongs to two triangles, which go along it in opposite directions: the one way is
    // enough. At a border one neighbour is missing, which does no harm.
    const auto& t = surface.triangles;
    for (const std::uint32_t p : t)
        ++first_[p + 1];
    for (std::size_t n = 1; n < first_.size(); ++n)
        first_[n] += first_[n - 1];
    neighbors_.resize(t.size());
    std::vector<std::uint32_t> filled(surface.pointCount(), 0);
    double sum_mm = 0;
    for (std::size_t n = 0; n < t.size(); ++n) {
        const std::uint32_t from = t[n], to = t[n % 3 == 2 ? n - 2 : n + 1];
        neighbors_[first_[from] + filled[from]++] = to;
        sum_mm += distance(surface.point(from), surface.point(to));
    }
    if (!t.empty())
        edge_mm_ = sum_mm / double(t.size());
}

void evenOut(std::vector<float>& values, std::size_t values_per_point, const SurfaceNeighbors& neighbors,
             double over_mm, Progress& progress)
{
    const double reach = over_mm / neighbors.edge_mm();
    if (!(reach > 0))
        return;
    const double hold = 1 / (reach * reach);
    const double shrink = 1 / (1 + hold);  // the most that Jacobi's method leaves of an error
    const int rounds = std::clamp(int(std::ceil(4 / std::sqrt(2 * hold))), 4, 200);
    const std::vector<float> wanted = values;
    std::vector<float> before = values;
    double over = 1;
    for (int round = 0; round < rounds; ++round) {
        progress.check();
        over = round == 0 ? 1 : round == 1 ? 2 / (2 - shrink * shrink) : 4 / (4 - shrink * shrink * over);
        jacobi(neighbors, values_per_point, {wanted, float(hold), float(over)}, values, before);
        values.swap(before);
    }
}

}  // namespace vicon::viewer
