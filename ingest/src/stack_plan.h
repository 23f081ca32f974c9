#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "stack.h"
#include "vicon/core/geometry.h"
#include "vicon/ingest/import.h"

namespace vicon::ingest {

/// Where a plane of the volume comes from: one slice, or two slices of the stack blended.
struct PlaneSource {
    std::size_t below = 0;  ///< index into Stack::slices
    std::size_t above = 0;  ///< the same when nothing is interpolated
    double part_above = 0;  ///< weight of `above`
    bool interpolated() const { return below != above; }
};

/// How a stack becomes a volume on an orthonormal grid.
struct StackPlan {
    Grid grid;                        ///< axes: along a row, along a column, along the normal
    std::vector<PlaneSource> planes;  ///< one for each k of the grid
    /// For each slice of the stack, where its first pixel lies in the grid's plane, in pixels; whole numbers and zero
    /// where nothing is tilted.
    std::vector<std::array<double, 2>> shift_pixels;
    bool tilted = false;
    std::vector<std::string> repairs;
    std::string refused;                                 ///< why there is no volume; empty when there is
    nlohmann::json geometry = nlohmann::json::object();  ///< for scan.json
};

/// Fits an even grid to the slices, which need not be refused by splitSeries().
StackPlan planStack(const Stack& stack, const ImportOptions& options);

/// The same grid with its axes in the order and direction that come closest to left, posterior, superior, right-handed,
/// and how its indices follow from those of `grid`: new axis a is old axis `from[a]`, reversed when `flipped[a]`.
struct NearestToPatient {
    Grid grid;
    std::array<int, 3> from{0, 1, 2};
    std::array<bool, 3> flipped{};
};
NearestToPatient nearestToPatient(const Grid& grid);

}  // namespace vicon::ingest
