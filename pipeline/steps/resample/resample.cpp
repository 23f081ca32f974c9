#include "vicon/steps/resample.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "grid/allocate.h"

namespace vicon::steps {
namespace {

/// A sample nearer than this to a voxel, in voxels, is that voxel: what remains is rounding of the spacings.
constexpr double kOnVoxel = 1e-6;
/// Origins are rounded to this, so that mirrored storage, whose origin is computed from the other end, gives the same.
constexpr double kOriginStep_mm = 1e-6;
/// The first neighbour's weight is exact and the others' are at most one; 32768 makes every HU positive for truncation.
constexpr float kAboveAllHu = 32768;

/// The acquired voxels seen along axes that lie nearest to +x, +y, +z.
struct CanonicalView {
    const std::int16_t* first = nullptr;  ///< the voxel of least x, y, z
    std::array<std::ptrdiff_t, 3> stride{};
    Grid grid;
};

std::array<std::size_t, 3> nearestPermutation(const std::array<Vector3, 3>& axis)
{
    std::array<std::size_t, 3> order{0, 1, 2}, best = order;
    double most = -1;
    do {
        const double along = std::abs(axis[order[0]].x) + std::abs(axis[order[1]].y) + std::abs(axis[order[2]].z);
        if (along > most + 1e-9) {
            most = along;
            best = order;
        }
    } while (std::next_permutation(order.begin(), order.end()));
    return best;
}

double rounded(double mm)
{
    return std::round(mm / kOriginStep_mm) * kOriginStep_mm + 0.0;
}

CanonicalView canonicalView(const HuVolume& acquired)
{
    const Grid& from = acquired.grid;
    const std::array<std::ptrdiff_t, 3> stride{1, from.size[0], std::ptrdiff_t(from.size[0]) * from.size[1]};
    const auto order = nearestPermutation(from.axis);
    CanonicalView view{.first = acquired.voxels.data(), .grid = from};
    for (std::size_t d = 0; d < 3; ++d) {
        const std::size_t a = order[d];
        const Vector3 axis = from.axis[a];
        const double component = d == 0 ? axis.x : d == 1 ? axis.y : axis.z;
        const double sign = component < 0 ? -1 : 1;
        view.grid.size[d] = from.size[a];
        view.grid.spacing_mm[d] = from.spacing_mm[a];
        view.grid.axis[d] = {sign * axis.x + 0.0, sign * axis.y + 0.0, sign * axis.z + 0.0};
        view.stride[d] = sign < 0 ? -stride[a] : stride[a];
        if (sign < 0) {
            view.first += stride[a] * (from.size[a] - 1);
            view.grid.origin_mm += axis * (from.spacing_mm[a] * (from.size[a] - 1));
        }
    }
    const Point3 origin = view.grid.origin_mm;
    view.grid.origin_mm = {rounded(origin.x), rounded(origin.y), rounded(origin.z)};
    return view;
}

/// Between which two acquired voxels a new one lies along one axis; high == low where it lies on one.
struct Tap {
    int low = 0, high = 0;
    float weight = 0;  ///< of `high`
};

std::vector<Tap> tapsFor(int count, double spacing_mm, int acquired_count, double acquired_spacing_mm)
{
    std::vector<Tap> taps(static_cast<std::size_t>(count));
    for (int n = 0; n < count; ++n) {
        const double at = std::min(n * spacing_mm / acquired_spacing_mm, double(acquired_count - 1));
        int low = int(at);
        double weight = at - low;
        if (weight > 1 - kOnVoxel) {
            ++low;
            weight = 0;
        }
        const bool on = weight < kOnVoxel || low + 1 >= acquired_count;
        taps[std::size_t(n)] = {low, on ? low : low + 1, on ? 0.0F : float(weight)};
    }
    return taps;
}

int samplesAlong(int acquired_count, double acquired_spacing_mm, double spacing_mm)
{
    const double samples = std::floor((acquired_count - 1) * acquired_spacing_mm / spacing_mm + kOnVoxel) + 1;
    if (samples > 1e6)
        throw Error(ErrorCode::no_memory, "the resampled volume would be more than a million voxels long", {},
                    "set resample.spacing_mm to a larger spacing");
    return int(samples);
}

/// Fills rows of the new volume from a view; one per thread.
class RowSampler {
public:
    RowSampler(const CanonicalView& view, const std::vector<Tap>& taps)
        : view_(view), taps_(taps), mixed_(std::size_t(view.grid.size[0])), padding_(mixed_.size())
    {
        for (auto& copy : copies_)
            copy.resize(std::size_t(view.grid.size[0]));
        columns_stay_ = taps.size() == mixed_.size();
        for (std::size_t i = 0; i < taps.size() && columns_stay_; ++i)
            columns_stay_ = taps[i].low == int(i) && taps[i].high == int(i);
    }

    void sample(Tap y, Tap z, std::int16_t* out)
    {
        const std::array<const std::int16_t*, 4> row{acquiredRow(0, y.low, z.low), acquiredRow(1, y.high, z.low),
                                                     acquiredRow(2, y.low, z.high), acquiredRow(3, y.high, z.high)};
        if (columns_stay_ && y.low == y.high)
            between(row[0], row[2], z.weight, out);
        else
            amongFour(row, y, z, out);
        // Almost every row crosses the corners outside the reconstruction circle; few of its voxels lie there.
        if (markPadding(row))
            for (std::size_t i = 0; i < taps_.size(); ++i)
                if (padding_[std::size_t(taps_[i].low)] | padding_[std::size_t(taps_[i].high)])
                    out[i] = nearest(row, taps_[i], y, z);
    }

private:
    /// New slices between those acquired and nothing else: what most scans need.
    void between(const std::int16_t* near, const std::int16_t* far, float weight, std::int16_t* out) const
    {
        for (std::size_t i = 0; i < taps_.size(); ++i)
            out[i] = toHu(float(near[i]) + weight * (float(far[i]) - float(near[i])));
    }
    void amongFour(const std::array<const std::int16_t*, 4>& row, Tap y, Tap z, std::int16_t* out)
    {
        for (std::size_t i = 0; i < mixed_.size(); ++i) {
            const float near = float(row[0][i]) + y.weight * (float(row[1][i]) - float(row[0][i]));
            const float far = float(row[2][i]) + y.weight * (float(row[3][i]) - float(row[2][i]));
            mixed_[i] = near + z.weight * (far - near);
        }
        for (std::size_t i = 0; i < taps_.size(); ++i) {
            const float low = mixed_[std::size_t(taps_[i].low)], high = mixed_[std::size_t(taps_[i].high)];
            out[i] = toHu(low + taps_[i].weight * (high - low));
        }
    }
    static std::int16_t toHu(float value)
    {
        return std::int16_t(std::int32_t(value + (kAboveAllHu + 0.5F)) - std::int32_t(kAboveAllHu));
    }

    const std::int16_t* acquiredRow(std::size_t slot, int j, int k)
    {
        const std::int16_t* first = view_.first + view_.stride[1] * j + view_.stride[2] * k;
        if (view_.stride[0] == 1)
            return first;
        auto& copy = copies_[slot];
        for (std::size_t i = 0; i < copy.size(); ++i)
            copy[i] = first[view_.stride[0] * std::ptrdiff_t(i)];
        return copy.data();
    }

    /// Notes which columns hold padding in any of the four rows; false where none does.
    bool markPadding(const std::array<const std::int16_t*, 4>& row)
    {
        unsigned found = 0;
        for (std::size_t i = 0; i < padding_.size(); ++i) {
            padding_[i] = std::uint8_t(int(row[0][i] == kPaddingHu) | int(row[1][i] == kPaddingHu) |
                                       int(row[2][i] == kPaddingHu) | int(row[3][i] == kPaddingHu));
            found |= padding_[i];
        }
        return found != 0;
    }

    static std::int16_t nearest(const std::array<const std::int16_t*, 4>& row, Tap x, Tap y, Tap z)
    {
        return row[std::size_t(y.weight >= 0.5F) + 2 * std::size_t(z.weight >= 0.5F)]
                  [std::size_t(x.weight >= 0.5F ? x.high : x.low)];
    }

    const CanonicalView& view_;
    const std::vector<Tap>& taps_;
    bool columns_stay_ = false;  ///< the new columns are those acquired
    std::vector<float> mixed_;
    std::vector<std::uint8_t> padding_;
    std::array<std::vector<std::int16_t>, 4> copies_;
};

void requireVoxels(const HuVolume& acquired)
{
    const Grid& grid = acquired.grid;
    for (std::size_t d = 0; d < 3; ++d)
        if (grid.size[d] < 1 || !(grid.spacing_mm[d] > 0) || !std::isfinite(grid.spacing_mm[d]))
            throw Error(ErrorCode::bad_input, "the volume has no voxels or no spacing");
    if (acquired.voxels.size() != grid.voxelCount())
        throw Error(ErrorCode::bad_input, "the volume's voxels do not fit its grid");
}

}  // namespace

HuVolume resample(HuVolume acquired, const ResampleOptions& options, Progress& progress)
{
    requireVoxels(acquired);
    progress.report(0, "resampling");
    const CanonicalView view = canonicalView(acquired);
    const auto& from = view.grid;
    const double spacing_mm =
        options.spacing_mm > 0 ? options.spacing_mm : *std::min_element(from.spacing_mm.begin(), from.spacing_mm.end());
    Grid grid = from;
    std::array<std::vector<Tap>, 3> taps;
    for (std::size_t d = 0; d < 3; ++d) {
        grid.size[d] = samplesAlong(from.size[d], from.spacing_mm[d], spacing_mm);
        grid.spacing_mm[d] = spacing_mm;
        taps[d] = tapsFor(grid.size[d], spacing_mm, from.size[d], from.spacing_mm[d]);
    }
    const bool as_stored = view.first == acquired.voxels.data() && view.stride[0] == 1 &&
                           view.stride[1] == acquired.grid.size[0] && grid.size == acquired.grid.size;
    if (as_stored && from.spacing_mm == grid.spacing_mm) {
        acquired.grid = grid;
        return acquired;
    }
    auto out = makeVolume<std::int16_t>(grid);
    tbb::parallel_for(tbb::blocked_range<int>(0, grid.size[2]), [&](const tbb::blocked_range<int>& range) {
        RowSampler sampler(view, taps[0]);
        for (int k = range.begin(); k < range.end(); ++k) {
            for (int j = 0; j < grid.size[1]; ++j)
                sampler.sample(taps[1][std::size_t(j)], taps[2][std::size_t(k)], &out.at({0, j, k}));
        }
    });
    progress.check();
    progress.report(1, "resampling");
    return out;
}

}  // namespace vicon::steps
