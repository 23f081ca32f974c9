#include "segment/field_of_view.h"

#include <tbb/parallel_for.h>

#include <array>
#include <numeric>
#include <vector>

#include "grid/byte_rows.h"
#include "grid/lattice.h"
#include "segment/constants.h"

namespace vicon::steps {
namespace {

// Share of the places at the edge of what was measured that lie in the body. No case recorded;
// half and double leave the three cases (CONTRIBUTING.md) as they are.
constexpr double kCutShare = 0.05;

}  // namespace

double lumenCut_mm2(const HuVolume& volume, const InsideVolume& inside)
{
    if (inside.voxels.empty())
        return 0;
    const Index3 offset = latticeOffset(inside.grid, volume.grid);
    const auto& spacing = volume.grid.spacing_mm;
    const std::array<double, 3> face_mm2{spacing[1] * spacing[2], spacing[0] * spacing[2], spacing[0] * spacing[1]};
    const auto [nx, ny, nz] = inside.grid.size;
    std::vector<double> slices(std::size_t(nz), 0.0);
    const auto ends = [&](Index3 v) { return volume.valueOr(v, kPaddingHu) == kPaddingHu; };
    tbb::parallel_for(0, nz, [&, nx = nx, ny = ny](int k) {
        double& area = slices[std::size_t(k)];
        for (int j = 0; j < ny; ++j) {
            const std::uint8_t* row = &inside.voxels[inside.grid.offset({0, j, k})];
            for (int i = firstOther(row, 0, nx, kOutside); i < nx; i = firstOther(row, i + 1, nx, kOutside)) {
                const Index3 v{i + offset.i, j + offset.j, k + offset.k};
                area += face_mm2[0] * (ends({v.i - 1, v.j, v.k}) + ends({v.i + 1, v.j, v.k})) +
                        face_mm2[1] * (ends({v.i, v.j - 1, v.k}) + ends({v.i, v.j + 1, v.k})) +
                        face_mm2[2] * (ends({v.i, v.j, v.k - 1}) + ends({v.i, v.j, v.k + 1}));
            }
        }
    });
    return std::accumulate(slices.begin(), slices.end(), 0.0);
}

bool bodyIsCut(const Body& body)
{
    const auto& blocks = body.mean_hu;
    const auto [nx, ny, nz] = blocks.grid.size;
    int cut = 0, all = 0;
    // Along a line into the volume: what was not measured, a block that is half of it, and then air, or tissue.
    const auto look = [&](Index3 v, int di, int dj) {
        while (blocks.grid.contains(v) && blocks.at(v) == kPaddingHu)
            v = {v.i + di, v.j + dj, v.k};
        const Index3 next{v.i + di, v.j + dj, v.k};
        if (!blocks.grid.contains(next))
            return;
        ++all;
        cut += blocks.at(next) > kBody_hu ? 1 : 0;
    };
    for (int k = 0; k < nz; ++k) {
        for (int i = 0; i < nx; ++i) {
            look({i, 0, k}, 0, 1);
            look({i, ny - 1, k}, 0, -1);
        }
        for (int j = 0; j < ny; ++j) {
            look({0, j, k}, 1, 0);
            look({nx - 1, j, k}, -1, 0);
        }
    }
    return cut > 0 && cut >= kCutShare * all;
}

}  // namespace vicon::steps
