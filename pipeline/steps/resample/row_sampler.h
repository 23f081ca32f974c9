#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "resample/oriented_scan.h"
#include "resample/sampling.h"

namespace vicon::steps {

/// Makes rows of the new volume by linear interpolation between acquired rows, however these are stored. Padding stays
/// out of it: where a neighbour of a new voxel is padding, the nearest acquired voxel's value is taken.
/// One for each thread.
class RowSampler {
public:
    /// @param scan, sampling must outlive the sampler
    RowSampler(const OrientedScan& scan, const Sampling& sampling);

    /// Fills row j of slice k.
    void sample(int j, int k, std::int16_t* out);

private:
    using AroundRow = std::array<const std::int16_t*, 4>;  ///< y low and high in the lower slice, then in the higher

    const std::int16_t* acquiredRow(std::size_t slot, int j, int k);
    void amongFour(const AroundRow& row, Tap y, Tap z, std::int16_t* out);
    bool markPadding(const AroundRow& row);

    const Sampling& sampling_;
    const std::int16_t* first_;  ///< the acquired voxel of least x, y, z
    std::array<std::ptrdiff_t, 3> stride_{};
    std::vector<float> mixed_;
    std::vector<std::int16_t> padding_;  ///< which columns hold padding in one of the rows around the new one
    std::array<std::vector<std::int16_t>, 4> copies_;
};

}  // namespace vicon::steps
