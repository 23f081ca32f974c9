#include "vicon/viewer/model/outside_air.h"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace vicon::viewer {
namespace {

constexpr double kBesideClick_mm = 4;  // a little more than a point may lie beside what it means
constexpr int kPerhapsGas_hu = -400, kPerhapsFluid_hu = 100;

/// From a voxel of gas through the gas of its slice.
bool reachesEdge(const HuView& volume, Index3 from)
{
    const int width = volume.grid.size[0], height = volume.grid.size[1];
    std::vector<std::uint8_t> taken(std::size_t(width) * std::size_t(height));
    std::vector<std::pair<int, int>> todo;
    const auto take = [&](int i, int j) {
        std::uint8_t& known = taken[std::size_t(j) * std::size_t(width) + std::size_t(i)];
        if (known || volume.at({i, j, from.k}) >= kPerhapsGas_hu)
            return;
        known = 1;
        todo.emplace_back(i, j);
    };
    take(from.i, from.j);
    while (!todo.empty()) {
        const auto [i, j] = todo.back();
        todo.pop_back();
        if (i == 0 || j == 0 || i + 1 == width || j + 1 == height)
            return true;
        take(i - 1, j);
        take(i + 1, j);
        take(i, j - 1);
        take(i, j + 1);
    }
    return false;
}

struct Around {
    std::optional<Index3> gas;  // the nearest
    bool fluid = false;
};

Around lookAround(const HuView& volume, Point3 point)
{
    const Grid& grid = volume.grid;
    const Index3 middle = grid.indexAt(point);
    std::array<int, 3> reach{};
    for (std::size_t d = 0; d < 3; ++d)
        reach[d] = int(std::ceil(kBesideClick_mm / grid.spacing_mm[d]));
    Around found;
    double least_mm = 1e300;
    for (int k = middle.k - reach[2]; k <= middle.k + reach[2]; ++k)
        for (int j = middle.j - reach[1]; j <= middle.j + reach[1]; ++j)
            for (int i = middle.i - reach[0]; i <= middle.i + reach[0]; ++i) {
                const int hu = volume.valueOr({i, j, k}, 0);
                found.fluid = found.fluid || hu > kPerhapsFluid_hu;
                const double off_mm = distance(grid.pointAt(Index3{i, j, k}), point);
                if (hu < kPerhapsGas_hu && grid.contains({i, j, k}) && off_mm < least_mm) {
                    least_mm = off_mm;
                    found.gas = Index3{i, j, k};
                }
            }
    return found;
}

}  // namespace

LumenGuess guessLumen(const HuView& volume, Point3 point)
{
    if (!volume.grid.contains(volume.grid.indexAt(point)))
        return LumenGuess::outside_body;
    const Around around = lookAround(volume, point);
    if (around.gas && reachesEdge(volume, *around.gas))
        return LumenGuess::outside_body;
    return around.gas || around.fluid ? LumenGuess::possible : LumenGuess::tissue;
}

}  // namespace vicon::viewer
