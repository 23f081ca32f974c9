#pragma once

#include <cstdint>
#include <vector>

#include "stack_plan.h"
#include "vicon/core/volume.h"

namespace vicon::ingest {

/// Puts planes of a plan's grid into a volume whose axes are nearest to the patient's.
class VolumeWriter {
public:
    /// Allocates the volume, filled with padding. Throws Error{no_memory}.
    explicit VolumeWriter(const StackPlan& plan);

    /// A slice's pixels moved to their place in the plane of the grid (bilinear where that lies between pixels).
    std::vector<std::int16_t> inPlane(const std::vector<std::int16_t>& pixels, int columns, int rows,
                                      const std::array<double, 2>& shift_pixels) const;
    /// Threads may put different planes at the same time.
    void put(int k, const std::vector<std::int16_t>& plane);
    HuVolume take() { return std::move(volume_); }

    /// Linear between two densities; beside padding the nearer one alone counts.
    static std::int16_t blend(std::int16_t below, std::int16_t above, double part_above);

private:
    std::array<int, 3> size_;
    std::array<std::ptrdiff_t, 3> stride_{};
    std::ptrdiff_t first_ = 0;
    HuVolume volume_;
};

}  // namespace vicon::ingest
