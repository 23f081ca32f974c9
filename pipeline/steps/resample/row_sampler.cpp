#include "resample/row_sampler.h"

#include <algorithm>

#include "resample/rounded.h"
#include "vicon/core/volume.h"

namespace vicon::steps {
namespace {

/// New slices between those acquired and nothing else: what most scans need.
void between(const std::int16_t* near, const std::int16_t* far, float weight, std::size_t columns, std::int16_t* out)
{
    for (std::size_t i = 0; i < columns; ++i)
        out[i] = rounded(float(near[i]) + weight * (float(far[i]) - float(near[i])));
}

int isPadding(std::int16_t hu)
{
    return int(hu == kPaddingHu);
}

}  // namespace

RowSampler::RowSampler(const OrientedScan& scan, const Sampling& sampling)
    : sampling_(sampling),
      first_(scan.acquired.voxels.data()),
      mixed_(std::size_t(sampling.acquired_size[0])),
      padding_(mixed_.size())
{
    const auto& stored = scan.acquired.grid.size;
    const std::array<std::ptrdiff_t, 3> stride{1, stored[0], std::ptrdiff_t(stored[0]) * stored[1]};
    for (std::size_t d = 0; d < 3; ++d) {
        stride_[d] = stride[scan.order[d]];
        if (scan.flipped[d]) {
            first_ += stride_[d] * (sampling.acquired_size[d] - 1);
            stride_[d] = -stride_[d];
        }
    }
    if (stride_[0] != 1)
        for (auto& copy : copies_)
            copy.resize(mixed_.size());
}

const std::int16_t* RowSampler::acquiredRow(std::size_t slot, int j, int k)
{
    const std::int16_t* const first = first_ + stride_[1] * j + stride_[2] * k;
    if (stride_[0] == 1)
        return first;
    auto& copy = copies_[slot];
    for (std::size_t i = 0; i < copy.size(); ++i)
        copy[i] = first[stride_[0] * std::ptrdiff_t(i)];
    return copy.data();
}

void RowSampler::amongFour(const AroundRow& row, Tap y, Tap z, std::int16_t* out)
{
    for (std::size_t i = 0; i < mixed_.size(); ++i) {
        const float near = float(row[0][i]) + y.weight * (float(row[1][i]) - float(row[0][i]));
        const float far = float(row[2][i]) + y.weight * (float(row[3][i]) - float(row[2][i]));
        mixed_[i] = near + z.weight * (far - near);
    }
    for (const Tap& x : sampling_.taps[0]) {
        const float low = mixed_[std::size_t(x.low)], high = mixed_[std::size_t(x.high)];
        *out++ = rounded(low + x.weight * (high - low));
    }
}

/// Marks the columns that hold padding; false where none does.
bool RowSampler::markPadding(const AroundRow& row)
{
    const std::size_t columns = padding_.size();
    const auto [a, b, c, d] = row;
    int found = 0;
    for (std::size_t i = 0; i < columns; ++i)
        found |= isPadding(a[i]) | isPadding(b[i]) | isPadding(c[i]) | isPadding(d[i]);
    if (found == 0)
        return false;
    std::int16_t* const marks = padding_.data();
    for (std::size_t i = 0; i < columns; ++i)
        marks[i] = std::int16_t(isPadding(a[i]) | isPadding(b[i]) | isPadding(c[i]) | isPadding(d[i]));
    return true;
}

void RowSampler::sample(int j, int k, std::int16_t* out)
{
    const Tap y = sampling_.taps[1][std::size_t(j)], z = sampling_.taps[2][std::size_t(k)];
    const bool on_row = y.low == y.high;
    const std::int16_t *near = acquiredRow(0, y.low, z.low), *far = acquiredRow(1, y.low, z.high);
    const AroundRow row{near, on_row ? near : acquiredRow(2, y.high, z.low), far,
                        on_row ? far : acquiredRow(3, y.high, z.high)};
    if (on_row && !sampling_.moves(0))
        between(near, far, z.weight, mixed_.size(), out);
    else
        amongFour(row, y, z, out);
    if (!markPadding(row))
        return;
    const std::int16_t* const nearest = row[std::size_t(y.weight >= 0.5F) + 2 * std::size_t(z.weight >= 0.5F)];
    // Almost every row crosses the corners outside the reconstruction circle; few of its voxels lie there.
    for (const Tap& x : sampling_.taps[0]) {
        if (padding_[std::size_t(x.low)] | padding_[std::size_t(x.high)])
            *out = nearest[x.nearest()];
        ++out;
    }
}

}  // namespace vicon::steps
