#include "grid/slice_holes.h"

#include <tbb/parallel_for.h>

#include <vector>

namespace vicon::steps {
namespace {

void fillSlice(Volume<std::uint8_t>& mask, int k)
{
    const int nx = mask.grid.size[0], ny = mask.grid.size[1];
    std::vector<Index3> stack;
    std::vector<std::uint8_t> outside(std::size_t(nx) * std::size_t(ny), 0);
    const auto visit = [&](int i, int j) {
        if (i < 0 || j < 0 || i >= nx || j >= ny || mask.at({i, j, k}))
            return;
        std::uint8_t& seen = outside[std::size_t(i) + std::size_t(nx) * std::size_t(j)];
        if (!seen) {
            seen = 1;
            stack.push_back({i, j, k});
        }
    };
    for (int i = 0; i < nx; ++i) {
        visit(i, 0);
        visit(i, ny - 1);
    }
    for (int j = 0; j < ny; ++j) {
        visit(0, j);
        visit(nx - 1, j);
    }
    while (!stack.empty()) {
        const Index3 v = stack.back();
        stack.pop_back();
        visit(v.i - 1, v.j);
        visit(v.i + 1, v.j);
        visit(v.i, v.j - 1);
        visit(v.i, v.j + 1);
    }
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            mask.at({i, j, k}) = outside[std::size_t(i) + std::size_t(nx) * std::size_t(j)] ? 0 : 1;
}

}  // namespace

void fillSlices(Volume<std::uint8_t>& mask)
{
    tbb::parallel_for(0, mask.grid.size[2], [&](int k) { fillSlice(mask, k); });
}

}  // namespace vicon::steps
