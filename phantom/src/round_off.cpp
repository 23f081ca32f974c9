#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "lumen_field.h"

namespace vicon::phantom {
namespace {

constexpr std::int8_t kNear = 32;   // distances beyond 2 mm count as 2 mm: within folds they are no distances
constexpr double kPolypRim_mm = 2;  // around a polyp that is left as it is

/// 1-2-1 along two axes of a slice, times 16; the rim repeats.
std::vector<std::int16_t> filteredSlice(const LumenField& field, int k)
{
    const int nx = field.size[0], ny = field.size[1];
    const std::size_t at = std::size_t(nx) * std::size_t(ny) * std::size_t(std::clamp(k, 0, field.size[2] - 1));
    const std::int8_t* in = &field.lumen[at];
    std::vector<std::int16_t> rows(std::size_t(nx) * std::size_t(ny)), out(rows.size());
    const auto value = [&](int i, int j) {
        return std::int16_t(
            2 * std::clamp(in[std::size_t(j) * std::size_t(nx) + std::size_t(i)], std::int8_t(-kNear), kNear) + 1);
    };
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            rows[std::size_t(j) * std::size_t(nx) + std::size_t(i)] =
                std::int16_t(value(std::max(i - 1, 0), j) + 2 * value(i, j) + value(std::min(i + 1, nx - 1), j));
    for (int j = 0; j < ny; ++j) {
        const std::int16_t *here = &rows[std::size_t(j) * std::size_t(nx)],
                           *before = &rows[std::size_t(std::max(j - 1, 0)) * std::size_t(nx)],
                           *after = &rows[std::size_t(std::min(j + 1, ny - 1)) * std::size_t(nx)];
        for (int i = 0; i < nx; ++i)
            out[std::size_t(j) * std::size_t(nx) + std::size_t(i)] = std::int16_t(before[i] + 2 * here[i] + after[i]);
    }
    return out;
}

bool atPolyp(const std::vector<Polyp>& polyps, Point3 p)
{
    return std::any_of(polyps.begin(), polyps.end(), [p](const Polyp& polyp) {
        return distance(p, polyp.position_mm) < polyp.diameter_mm / 2 + kPolypRim_mm;
    });
}

}  // namespace

void roundOff(LumenField& field, const Grid& grid, const std::vector<Polyp>& polyps)
{
    constexpr int kSlab = 16;
    LumenField source;
    source.low = field.low;
    source.size = field.size;
    source.lumen = field.lumen;
    tbb::parallel_for(0, (field.size[2] + kSlab - 1) / kSlab, [&](int slab) {
        const int from = slab * kSlab, to = std::min(field.size[2], from + kSlab);
        std::vector<std::int16_t> before = filteredSlice(source, from - 1), here = filteredSlice(source, from);
        for (int k = from; k < to; ++k) {
            std::vector<std::int16_t> after = filteredSlice(source, k + 1);
            std::size_t at = here.size() * std::size_t(k), n = 0;
            for (int j = 0; j < field.size[1]; ++j)
                for (int i = 0; i < field.size[0]; ++i, ++n, ++at) {
                    const int sum = before[n] + 2 * here[n] + after[n];  // 128 times the distance, 1 off centre
                    const int rounded = int(std::floor(sum / 128.0));
                    if (std::abs(rounded) >= kNear - 1)
                        continue;
                    const Point3 p = grid.pointAt(Index3{field.low.i + i, field.low.j + j, field.low.k + k});
                    if (!atPolyp(polyps, p))
                        field.lumen[at] = std::int8_t(rounded);
                }
            before = std::move(here);
            here = std::move(after);
        }
    });
}

}  // namespace vicon::phantom
