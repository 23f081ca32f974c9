#include "resample/padding.h"

#include <algorithm>
#include <array>

#include "vicon/core/volume.h"

namespace vicon::steps {

PaddingGuard::PaddingGuard(const Sampling& sampling, const std::int16_t* acquired_slices, SliceRange acquired)
    : sampling_(sampling),
      first_(acquired_slices),
      begin_(acquired.begin),
      padding_(std::size_t(sampling.acquired_size[0]))
{
    const std::size_t slice = padding_.size() * std::size_t(sampling.acquired_size[1]);
    any_ = std::find(first_, first_ + slice * std::size_t(acquired.count()), kPaddingHu) !=
           first_ + slice * std::size_t(acquired.count());
}

const std::int16_t* PaddingGuard::acquiredRow(int j, int k) const
{
    return first_ +
           padding_.size() * (std::size_t(j) + std::size_t(sampling_.acquired_size[1]) * std::size_t(k - begin_));
}

void PaddingGuard::mend(int j, int k, std::int16_t* row)
{
    if (!any_)
        return;
    const Tap y = sampling_.taps[1][std::size_t(j)], z = sampling_.taps[2][std::size_t(k)];
    const std::array<const std::int16_t*, 4> around{acquiredRow(y.low, z.low), acquiredRow(y.high, z.low),
                                                    acquiredRow(y.low, z.high), acquiredRow(y.high, z.high)};
    unsigned found = 0;
    for (std::size_t i = 0; i < padding_.size(); ++i) {
        padding_[i] = std::uint8_t(int(around[0][i] == kPaddingHu) | int(around[1][i] == kPaddingHu) |
                                   int(around[2][i] == kPaddingHu) | int(around[3][i] == kPaddingHu));
        found |= padding_[i];
    }
    if (!found)
        return;
    const std::int16_t* nearest = acquiredRow(y.nearest(), z.nearest());
    const std::vector<Tap>& taps = sampling_.taps[0];
    // Almost every row crosses the corners outside the reconstruction circle; few of its voxels lie there.
    for (std::size_t i = 0; i < taps.size(); ++i)
        if (padding_[std::size_t(taps[i].low)] | padding_[std::size_t(taps[i].high)])
            row[i] = nearest[taps[i].nearest()];
}

}  // namespace vicon::steps
