#pragma once

#include <cstdint>
#include <vector>

#include "resample/sampling.h"

namespace vicon::steps {

/// Keeps padding out of a linear interpolation: where a neighbour of a new voxel is padding, the nearest acquired
/// voxel's value is taken.
class PaddingGuard {
public:
    /// @param acquired_slices oriented, from slice `begin` on; must outlive the guard, as must the sampling
    PaddingGuard(const Sampling& sampling, const std::int16_t* acquired_slices, SliceRange acquired);

    /// Mends an interpolated row.
    void mend(int j, int k, std::int16_t* row);

private:
    const std::int16_t* acquiredRow(int j, int k) const;

    const Sampling& sampling_;
    const std::int16_t* first_;
    int begin_;
    bool any_;
    std::vector<std::uint8_t> padding_;  ///< which columns hold padding in one of the rows around the new one
};

}  // namespace vicon::steps
