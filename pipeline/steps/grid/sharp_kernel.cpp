#include "grid/sharp_kernel.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "grid/allocate.h"

namespace vicon::steps {
namespace {

// Chosen on phantoms 401 and 402 with a sharp kernel (126 and 122 HU of overshoot); of the default phantom, the second
// phantom and ctc-prone edges overshoot by -80 to -5 HU.
constexpr double kSharp_hu = 60;
/// Makes of a sharp kernel's edges, 0.22 to 0.29 mm wide, those of a usual one, 0.7 mm.
constexpr double kSoftening_mm = 0.9;

// Geometry of an edge: pure gas before it, the brightest rim behind it, pure tissue after that.
constexpr double kGasBefore_mm = 3, kRim_mm = 1, kTissueFrom_mm = 4;
constexpr int kTissue_voxels = 3;
constexpr double kNearlyTissue = 0.87;  // of the step: the rim is counted from here
constexpr double kPureGas_hu = -800, kLeastTissue_hu = -50, kMostTissue_hu = 150;  // neither fat nor tagging
constexpr int kEachSlice = 11, kEachRow = 7;                                       // a sample: some thousand edges
constexpr std::size_t kLeastEdges = 200;

struct Offsets {
    explicit Offsets(double voxel_mm)
        : gas(std::lround(kGasBefore_mm / voxel_mm)),
          rim(std::lround(kRim_mm / voxel_mm)),
          tissue(std::lround(kTissueFrom_mm / voxel_mm))
    {
    }
    std::ptrdiff_t gas, rim, tissue;
    std::ptrdiff_t behind() const { return tissue + kTissue_voxels; }
};

/// Adds the density of the rim of each edge from gas to tissue in a row, read forwards or backwards.
/// @param step 1 or -1
void addRims(const std::int16_t* first, std::ptrdiff_t count, std::ptrdiff_t step, const Offsets& off, double nearly_hu,
             std::vector<std::int16_t>& rims)
{
    const auto at = [&](std::ptrdiff_t n) { return first[n * step]; };
    for (std::ptrdiff_t n = off.gas + 1; n + off.behind() <= count; ++n) {
        if (at(n) <= nearly_hu || at(n - 1) > nearly_hu || at(n - off.gas) >= kPureGas_hu)
            continue;
        double deep_hu = 0;
        for (int more = 0; more < kTissue_voxels; ++more)
            deep_hu += double(at(n + off.tissue + more)) / kTissue_voxels;
        if (deep_hu >= kLeastTissue_hu && deep_hu <= kMostTissue_hu)
            rims.push_back(at(n + off.rim));
    }
}

/// Half of a Gaussian's weights, the middle first; all together sum to one.
std::vector<float> gaussianHalf(double sigma_voxels)
{
    std::vector<double> weights;
    double sum = 0;
    for (int n = 0; n <= int(std::ceil(3 * sigma_voxels)); ++n) {
        weights.push_back(std::exp(-0.5 * n * n / (sigma_voxels * sigma_voxels)));
        sum += (n == 0 ? 1 : 2) * weights.back();
    }
    std::vector<float> half;
    for (const double weight : weights)
        half.push_back(float(weight / sum));
    return half;
}

/// Blurs a line of values that lie `apart` from each other; beyond its ends the last ones go on.
void blurLine(float* values, int count, std::ptrdiff_t apart, const std::vector<float>& half, std::vector<float>& line)
{
    const auto reach = std::ptrdiff_t(half.size()) - 1;
    line.clear();
    for (std::ptrdiff_t n = -reach; n < count + reach; ++n)
        line.push_back(values[std::clamp<std::ptrdiff_t>(n, 0, count - 1) * apart]);
    for (std::ptrdiff_t n = 0; n < count; ++n) {
        const float* at = line.data() + n + reach;
        float sum = half[0] * at[0];
        for (std::ptrdiff_t m = 1; m <= reach; ++m)
            sum += half[std::size_t(m)] * (at[-m] + at[m]);
        values[n * apart] = sum;
    }
}

}  // namespace

std::optional<double> edgeOvershoot_hu(const HuVolume& hu, const WallDensities& densities)
{
    const Offsets off(hu.grid.spacing_mm[0]);
    const auto [nx, ny, nz] = hu.grid.size;
    const double gas_hu = 2 * densities.wall_hu - densities.tissue_hu,
                 nearly_hu = gas_hu + kNearlyTissue * (densities.tissue_hu - gas_hu);
    std::vector<std::int16_t> rims;
    for (int k = 0; k < nz; k += kEachSlice)
        for (int j = 0; j < ny; j += kEachRow) {
            const std::int16_t* row = &hu.voxels[hu.grid.offset({0, j, k})];
            addRims(row, nx, 1, off, nearly_hu, rims);
            addRims(row + nx - 1, nx, -1, off, nearly_hu, rims);
        }
    if (rims.size() < kLeastEdges)
        return std::nullopt;
    const auto middle = rims.begin() + std::ptrdiff_t(rims.size() / 2);
    std::nth_element(rims.begin(), middle, rims.end());
    return *middle - densities.tissue_hu;
}

std::optional<SoftenedDensities> softened(const HuVolume& hu, const WallDensities& densities)
{
    const double overshoot_hu = edgeOvershoot_hu(hu, densities).value_or(0);
    if (overshoot_hu < kSharp_hu)
        return std::nullopt;
    SoftenedDensities soft{makeVolume<std::int16_t>(hu.grid), overshoot_hu};
    const auto along_i = gaussianHalf(kSoftening_mm / hu.grid.spacing_mm[0]),
               along_j = gaussianHalf(kSoftening_mm / hu.grid.spacing_mm[1]);
    tbb::parallel_for(0, hu.grid.size[2], [&](int k) {
        const auto [nx, ny, nz] = hu.grid.size;
        const std::size_t begin = hu.grid.offset({0, 0, k}), count = std::size_t(nx) * std::size_t(ny);
        const std::int16_t* acquired = &hu.voxels[begin];
        std::vector<float> slice(acquired, acquired + count), line;
        for (int j = 0; j < ny; ++j)
            blurLine(&slice[std::size_t(j) * std::size_t(nx)], nx, 1, along_i, line);
        for (int i = 0; i < nx; ++i)
            blurLine(&slice[std::size_t(i)], ny, nx, along_j, line);
        for (std::size_t n = 0; n < count; ++n)
            soft.hu.voxels[begin + n] = acquired[n] == kPaddingHu ? kPaddingHu : std::int16_t(std::lround(slice[n]));
    });
    return soft;
}

}  // namespace vicon::steps
