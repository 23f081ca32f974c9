#include "skeleton/section_fit.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <mutex>
#include <numbers>
#include <numeric>

namespace vicon::steps {
namespace {

// Chosen on phantoms 1, 3 and 301 to 305, full size.
constexpr double kTight = 3.5;           // of the residuals' spread: what deviates more does not count
constexpr double kLeastSpread_mm = 0.5;  // of noise and haustra
constexpr double kStartQuantile = 0.6;   // of the radii: of the wall between folds
constexpr int kFitRounds = 6;
constexpr double kFitSettled_mm = 0.03;  // coarser, and the curve of HuBMAP (reference shapes) falls to an OV of 0.96

// Each term is a power of the station times a wave of the angle: 1, cos t, sin t, cos 2 t, sin 2 t, cos 3 t, sin 3 t.
constexpr std::size_t kWaves = 7, kPowers = 5, kTerms = 17;
using Waves = std::array<double, kWaves>;
using Terms = std::array<double, kTerms>;
using Matrix = std::array<Terms, kTerms>;

struct Term {
    std::size_t wave = 0, power = 0;
};
/// A definition: the higher the wave, the fewer powers.
constexpr std::array<Term, kTerms> kTerm{{{0, 0},
                                          {0, 1},
                                          {0, 2},
                                          {0, 3},
                                          {0, 4},
                                          {1, 0},
                                          {1, 1},
                                          {1, 2},
                                          {1, 3},
                                          {2, 0},
                                          {2, 1},
                                          {2, 2},
                                          {2, 3},
                                          {3, 0},
                                          {4, 0},
                                          {5, 0},
                                          {6, 0}}};

/// Harmonics 0 to 6 of an angle: 1, cos t, sin t, ..., cos 6 t, sin 6 t, and one to make them even.
constexpr std::size_t kHarmonics = 14;
constexpr std::size_t kPowerSums = 2 * kPowers - 1;
using Harmonics = std::array<double, kHarmonics>;

Harmonics harmonicsAt(double t)
{
    Harmonics all{1};
    for (std::size_t m = 1; 2 * m < kHarmonics; ++m) {
        all[2 * m - 1] = std::cos(double(m) * t);
        all[2 * m] = std::sin(double(m) * t);
    }
    return all;
}

/// The waves of a ring's rays: by rays, and by waves for what is done with all rays at once.
struct Rays {
    explicit Rays(std::size_t count) : waves(kWaves * count)
    {
        for (std::size_t r = 0; r < count; ++r) {
            harmonics.push_back(harmonicsAt(2 * std::numbers::pi * double(r) / double(count)));
            for (std::size_t w = 0; w < kWaves; ++w)
                waves[w * count + r] = harmonics[r][w];
        }
    }
    std::size_t count() const { return harmonics.size(); }
    const double* wave(std::size_t w) const { return &waves[w * count()]; }

    std::vector<Harmonics> harmonics;
    std::vector<double> waves;
};

/// Made once for each number of rays.
const Rays& raysOf(std::size_t count)
{
    static std::mutex mutex;
    static std::map<std::size_t, Rays> all;
    const std::lock_guard lock(mutex);
    return all.try_emplace(count, count).first->second;
}

/// Powers 0 to 8 of a station, of products of two terms.
std::array<double, kPowerSums> powersOf(double along)
{
    std::array<double, kPowerSums> powers{1};
    for (std::size_t n = 1; n < kPowerSums; ++n)
        powers[n] = powers[n - 1] * along;
    return powers;
}

/// What the fit says of one ring: the factor of each wave there.
Waves onRing(const Terms& fit, double along)
{
    const auto powers = powersOf(along);
    Waves waves{};
    for (std::size_t n = 0; n < kTerms; ++n)
        waves[kTerm[n].wave] += fit[n] * powers[kTerm[n].power];
    return waves;
}

/// Solves the normal equations by Cholesky's method. The small ridge decides what the wall leaves open.
Terms solved(Matrix& m, Terms right)
{
    double trace = 0;
    for (std::size_t n = 0; n < kTerms; ++n)
        trace += m[n][n];
    for (std::size_t n = 0; n < kTerms; ++n)
        m[n][n] += 1e-6 * trace + 1e-12;
    for (std::size_t c = 0; c < kTerms; ++c)
        for (std::size_t r = c; r < kTerms; ++r) {
            double sum = m[r][c];
            for (std::size_t k = 0; k < c; ++k)
                sum -= m[r][k] * m[c][k];
            m[r][c] = r == c ? std::sqrt(std::max(sum, 1e-12)) : sum / m[c][c];
        }
    for (std::size_t r = 0; r < kTerms; ++r) {
        for (std::size_t k = 0; k < r; ++k)
            right[r] -= m[r][k] * right[k];
        right[r] /= m[r][r];
    }
    for (std::size_t r = kTerms; r-- > 0;) {
        for (std::size_t k = r + 1; k < kTerms; ++k)
            right[r] -= m[k][r] * right[k];
        right[r] /= m[r][r];
    }
    return right;
}

/// Sums over the wall of all that the normal equations are made of. A product of two waves is half the sum of two
/// harmonics, so 13 sums over a ring's rays tell its 28 products; all of a ring's points have the same powers.
class Sums {
public:
    void add(const WallRing& ring, const Rays& rays, const double* weights)
    {
        Harmonics of_weights{};
        std::array<double, kWaves + 1> of_radii{};
        for (std::size_t r = 0; r < rays.count(); ++r) {
            if (weights[r] <= 0)
                continue;
            const Harmonics& harmonics = rays.harmonics[r];
            const double weighted = weights[r] * ring.radii_mm[r];
            for (std::size_t h = 0; h < kHarmonics; ++h)
                of_weights[h] += weights[r] * harmonics[h];
            for (std::size_t h = 0; h < of_radii.size(); ++h)
                of_radii[h] += weighted * harmonics[h];
        }
        const auto powers = powersOf(ring.along);
        for (std::size_t p = 0; p < kPowerSums; ++p)
            for (std::size_t h = 0; h < kHarmonics; ++h)
                weights_[p][h] += powers[p] * of_weights[h];
        for (std::size_t p = 0; p < kPowers; ++p)
            for (std::size_t h = 0; h < of_radii.size(); ++h)
                radii_[p][h] += powers[p] * of_radii[h];
    }

    /// The least squares' fit.
    Terms fit() const
    {
        Matrix matrix{};
        Terms right{};
        for (std::size_t a = 0; a < kTerms; ++a) {
            right[a] = radii_[kTerm[a].power][kTerm[a].wave];
            for (std::size_t b = 0; b <= a; ++b)
                matrix[a][b] = product(kTerm[a].wave, kTerm[b].wave, weights_[kTerm[a].power + kTerm[b].power]);
        }
        return solved(matrix, right);
    }

private:
    /// The sum of a product of waves a >= b, from those of the harmonics.
    static double product(std::size_t a, std::size_t b, const Harmonics& sums)
    {
        const auto cosine = [&](std::size_t m) { return m == 0 ? sums[0] : sums[2 * m - 1]; };
        const auto sine = [&](std::size_t m) { return m == 0 ? 0.0 : sums[2 * m]; };
        const std::size_t m = (a + 1) / 2, n = (b + 1) / 2;  // m >= n
        const bool a_is_sine = a > 0 && a % 2 == 0, b_is_sine = b > 0 && b % 2 == 0;
        if (a_is_sine == b_is_sine)
            return (cosine(m - n) + (a_is_sine ? -cosine(m + n) : cosine(m + n))) / 2;
        return (sine(m + n) + (a_is_sine ? sine(m - n) : -sine(m - n))) / 2;
    }

    std::array<Harmonics, kPowerSums> weights_{};
    std::array<std::array<double, kWaves + 1>, kPowers> radii_{};
};

/// The value of which `share` of the others are smaller. It is sought among those of its bin alone.
double quantile(const std::vector<double>& values, double share)
{
    if (values.empty())
        return 0;
    constexpr std::size_t kBins = 256;  // for speed alone: the value is exact
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const double low = *least, scale = double(kBins) / std::max(*most - low, 1e-9);
    const auto binOf = [&](double value) { return std::min(kBins - 1, std::size_t((value - low) * scale)); };
    std::array<std::size_t, kBins> counts{};
    for (const double value : values)
        ++counts[binOf(value)];
    auto rank = std::size_t(share * double(values.size() - 1));
    std::size_t bin = 0;
    for (; rank >= counts[bin]; ++bin)
        rank -= counts[bin];
    std::vector<double> in_bin;
    in_bin.reserve(counts[bin]);
    std::copy_if(values.begin(), values.end(), std::back_inserter(in_bin),
                 [&](double value) { return binOf(value) == bin; });
    std::nth_element(in_bin.begin(), in_bin.begin() + std::ptrdiff_t(rank), in_bin.end());
    return in_bin[rank];
}

/// Tukey's biweight, from a circle on: folds and openings end up without weight.
class RobustFit {
public:
    explicit RobustFit(const std::vector<WallRing>& wall)
        : wall_(wall), rays_(raysOf(wall.front().radii_mm.size())), deviations_mm_(wall.size() * rays_.count())
    {
        certain_mm_.reserve(deviations_mm_.size());
        for (const WallRing& ring : wall) {
            const double from_middle = std::abs(ring.along);
            const double rest = std::max(0.0, 1 - from_middle * from_middle * from_middle);
            fading_.push_back(rest * rest * rest);
        }
        deviate();  // the radii themselves
        fit_[0] = quantile(certain_mm_, kStartQuantile);
    }

    void run()
    {
        for (int round = 0; round < kFitRounds; ++round) {
            deviate();
            spread_mm_ = 1.48 * quantile(certain_mm_, 0.5);
            const Terms before = fit_;
            fit_ = fitOnce(kTight * std::max(kLeastSpread_mm, spread_mm_));
            if (differenceOf(fit_, before) < kFitSettled_mm)
                break;
        }
    }

    const Terms& fit() const { return fit_; }
    double spread_mm() const { return spread_mm_; }

private:
    /// What the wall deviates from the fit, ray by ray, and of these where it is certain at all.
    void deviate()
    {
        certain_mm_.clear();
        for (std::size_t n = 0; n < wall_.size(); ++n) {
            const WallRing& ring = wall_[n];
            const Waves fitted = onRing(fit_, ring.along);
            double* deviations_mm = &deviations_mm_[n * rays_.count()];
            std::fill_n(deviations_mm, rays_.count(), fitted[0]);
            for (std::size_t w = 1; w < kWaves; ++w)
                for (std::size_t r = 0; r < rays_.count(); ++r)
                    deviations_mm[r] += fitted[w] * rays_.wave(w)[r];
            for (std::size_t r = 0; r < rays_.count(); ++r)
                deviations_mm[r] = std::abs(ring.radii_mm[r] - deviations_mm[r]);
            for (std::size_t r = 0; r < rays_.count(); ++r)
                if (ring.certainty[r] > 0)
                    certain_mm_.push_back(deviations_mm[r]);
        }
    }

    /// The least squares' fit. Rays near the middle of the stretch count, those far from the fit before do not.
    Terms fitOnce(double limit_mm) const
    {
        Sums sums;
        std::vector<double> weights(rays_.count());
        for (std::size_t n = 0; n < wall_.size(); ++n) {
            for (std::size_t r = 0; r < weights.size(); ++r) {
                const double u = std::min(deviations_mm_[n * weights.size() + r] / limit_mm, 1.0);
                weights[r] = double(wall_[n].certainty[r]) * fading_[n] * (1 - u * u) * (1 - u * u);
            }
            sums.add(wall_[n], rays_, weights.data());
        }
        return sums.fit();
    }

    /// By how much the section in the middle of the stretch differs, at most, along any ray.
    static double differenceOf(const Terms& a, const Terms& b)
    {
        double sum = 0;
        for (std::size_t n = 0; n < kTerms; ++n)
            if (kTerm[n].power == 0)
                sum += std::abs(a[n] - b[n]);
        return sum;
    }

    const std::vector<WallRing>& wall_;
    const Rays& rays_;
    std::vector<double> fading_;         ///< of each ring
    std::vector<double> deviations_mm_;  ///< of each ray, ring by ring
    std::vector<double> certain_mm_;
    Terms fit_{};
    double spread_mm_ = 0;
};

/// The centroid of the fitted section in the middle of the stretch, across the line.
std::array<double, 2> centroid(const Terms& fit)
{
    constexpr std::size_t kAngles = 64;  // for waves up to the third many times enough
    const Waves ring = onRing(fit, 0);
    double area = 0, x = 0, y = 0;
    for (const Harmonics& waves : raysOf(kAngles).harmonics) {
        const double d = std::max(std::inner_product(ring.begin(), ring.end(), waves.begin(), 0.0), 0.0);
        area += d * d / 2;
        x += d * d * d / 3 * waves[1];
        y += d * d * d / 3 * waves[2];
    }
    return area > 0 ? std::array{x / area, y / area} : std::array{0.0, 0.0};
}

}  // namespace

SectionFit fitSection(const std::vector<WallRing>& wall)
{
    RobustFit robust(wall);
    robust.run();
    return {centroid(robust.fit()), robust.fit()[0], robust.spread_mm()};
}

}  // namespace vicon::steps
