#include "profile_features.h"

#include <algorithm>
#include <cmath>

namespace vicon {
namespace {

// Folds lie 20 to 35 mm apart and are 2 to 4 mm thick; a centreline's clearance and a cross-section's width show them
// some 10 mm wide. Chosen among half and double of each on pairs of postures, seeds 1 to 200.
constexpr double kFine_mm = 3;      // sigma: what is finer is noise
constexpr double kRipple_mm = 25;   // sigma: what is slower is distension
constexpr double kPatient_mm = 60;  // sigma of the width itself
constexpr double kTrend_mm = 400;   // and of what is taken off it
constexpr double kBeside_mm = 12;   // a lumen closes over about 10 mm
// Of the relief, chosen on whole scans of stretched phantoms, seeds 21 to 44.
constexpr double kFold_mm = 2,
                 kHaustra_mm = 15;        // sigmas: what is finer is voxels, what is slower distension and bends
constexpr double kFarWall_mm = 25;        // beyond it a ray runs along the colon
constexpr double kNeighbourhood_mm = 25;  // sigma
constexpr double kMostDeviations = 2.5;

/// Averages weighed by a Gaussian, over what is known.
std::vector<double> smoothed(const std::vector<double>& values, const std::vector<double>& weights, double sigma_mm)
{
    const int reach = int(3 * sigma_mm), count = int(values.size());
    std::vector<double> kernel, out(values.size(), 0);
    for (int n = 0; n <= reach; ++n)
        kernel.push_back(std::exp(-0.5 * n * n / (sigma_mm * sigma_mm)));
    for (int n = 0; n < count; ++n) {
        double sum = 0, total = 1e-9;
        for (int m = std::max(0, n - reach); m <= std::min(count - 1, n + reach); ++m) {
            const double weight = kernel[std::size_t(std::abs(m - n))] * weights[std::size_t(m)];
            sum += weight * values[std::size_t(m)];
            total += weight;
        }
        out[std::size_t(n)] = sum / total;
    }
    return out;
}

std::vector<float> standardised(const std::vector<double>& values, const std::vector<double>& weights)
{
    double sum = 0, squares = 0, total = 1e-9;
    for (std::size_t n = 0; n < values.size(); ++n) {
        sum += weights[n] * values[n];
        squares += weights[n] * values[n] * values[n];
        total += weights[n];
    }
    const double mean = sum / total, deviation = std::sqrt(std::max(1e-12, squares / total - mean * mean));
    std::vector<float> out;
    for (const double value : values)
        out.push_back(float((value - mean) / deviation));
    return out;
}

std::vector<double> band(const std::vector<double>& values, const std::vector<double>& known, double fine_mm,
                         double coarse_mm)
{
    const std::vector<double> fine = smoothed(values, known, fine_mm), coarse = smoothed(values, known, coarse_mm);
    std::vector<double> out;
    for (std::size_t n = 0; n < values.size(); ++n)
        out.push_back(fine[n] - coarse[n]);
    return out;
}

/// Each sector's mean logarithm, at each mm.
std::vector<double> sectorOf(const WallRelief& relief, std::size_t sector)
{
    constexpr std::size_t kRays = WallRelief::kDirections / ProfileFeatures::kSectors;
    std::vector<double> out;
    for (const auto& radii : relief.radius_mm) {
        double sum = 0;
        for (std::size_t ray = sector * kRays; ray < (sector + 1) * kRays; ++ray)
            sum += std::log(std::clamp(double(radii[ray]), 1.0, kFarWall_mm));
        out.push_back(sum / kRays);
    }
    return out;
}

std::vector<std::array<float, ProfileFeatures::kSectors>> foldsOf(const WallRelief& relief,
                                                                  const std::vector<double>& known)
{
    std::vector<std::array<float, ProfileFeatures::kSectors>> out(relief.radius_mm.size());
    std::vector<double> squares(out.size(), 0);
    for (std::size_t sector = 0; sector < ProfileFeatures::kSectors; ++sector) {
        const std::vector<double> folds = band(sectorOf(relief, sector), known, kFold_mm, kHaustra_mm);
        for (std::size_t n = 0; n < out.size(); ++n) {
            out[n][sector] = float(folds[n]);
            squares[n] += folds[n] * folds[n] / ProfileFeatures::kSectors;
        }
    }
    const std::vector<double> around = smoothed(squares, known, kNeighbourhood_mm);
    for (std::size_t n = 0; n < out.size(); ++n)
        for (float& value : out[n])
            value = float(std::clamp(value / std::sqrt(std::max(1e-6, around[n])), -kMostDeviations, kMostDeviations));
    return out;
}

std::vector<double> logarithms(const std::vector<double>& values, std::size_t count)
{
    std::vector<double> out(count, 0);
    for (std::size_t n = 0; n < std::min(count, values.size()); ++n)
        out[n] = std::log(std::max(values[n], 1.0));
    return out;
}

}  // namespace

ProfileFeatures featuresOf(const ColonProfile& profile)
{
    const auto count = std::size_t(std::max(1.0, profile.length_mm)) + 1;
    std::vector<double> known(count, 1);
    for (std::size_t n = 0; n < count; ++n)
        for (const StationRange& bridge : profile.bridges)
            if (double(n) > bridge.from_mm - kBeside_mm && double(n) < bridge.to_mm + kBeside_mm)
                known[n] = 0;
    ProfileFeatures out;
    out.known.assign(known.begin(), known.end());
    if (!profile.clearance_mm.empty()) {
        const std::vector<double> clearance = logarithms(profile.clearance_mm, count);
        out.value[0] = standardised(band(clearance, known, kFine_mm, kRipple_mm), known);
    }
    if (!profile.width_mm.empty()) {
        const std::vector<double> width = logarithms(profile.width_mm, count);
        out.value[1] = standardised(band(width, known, kFine_mm, kRipple_mm), known);
        out.value[2] = standardised(band(width, known, kPatient_mm, kTrend_mm), known);
    }
    if (profile.relief.radius_mm.size() == count)
        out.folds = foldsOf(profile.relief, known);
    return out;
}

}  // namespace vicon
