#pragma once

#include <cstdint>
#include <vector>

#include "vicon/core/cell_surface.h"
#include "vicon/core/progress.h"

namespace vicon::viewer {

/// Which points of a surface are joined by an edge.
class SurfaceNeighbors {
public:
    explicit SurfaceNeighbors(const CellSurface& surface);

    std::size_t pointCount() const { return first_.size() - 1; }
    const std::uint32_t* begin(std::size_t point) const { return neighbors_.data() + first_[point]; }
    const std::uint32_t* end(std::size_t point) const { return neighbors_.data() + first_[point + 1]; }
    /// The mean length of an edge.
    double edge_mm() const { return edge_mm_; }

private:
    std::vector<std::uint32_t> first_, neighbors_;
    double edge_mm_ = 1;
};

/// Evens out values of a surface's points over some `over_mm` of it: each becomes the mean of its neighbours, held to
/// what it was (the screened Poisson equation; G. Golub and R. Varga, Chebyshev semi-iterative
/// methods, Numerische Mathematik 3, 1961). The values of a point lie together.
/// Throws Error{cancelled}.
void evenOut(std::vector<float>& values, std::size_t values_per_point, const SurfaceNeighbors& neighbors,
             double over_mm, Progress& progress);

}  // namespace vicon::viewer
