#include "skeleton/section_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vicon::steps {
namespace {

// Chosen on phantoms 1, 3 and 301 to 305, full size.
constexpr double kTight = 3.5;           // of the residuals' spread: what deviates more does not count
constexpr double kLeastSpread_mm = 0.5;  // of noise and haustra
constexpr double kStartQuantile = 0.6;   // of the radii: of the wall between folds
constexpr int kRounds = 6;
constexpr double kSettled_mm = 0.03;  // coarser, and the curve of HuBMAP (reference shapes) falls to an OV of 0.96

// Each term is a power of the station times a wave of the angle: 1, cos t, sin t, cos 2 t, sin 2 t, cos 3 t, sin 3 t.
constexpr std::size_t kWaves = 7, kPowers = 5, kTerms = 17;
using Waves = std::array<double, kWaves>;
using Terms = std::array<double, kTerms>;
using Matrix = std::array<Terms, kTerms>;

struct Term {
    std::size_t wave = 0, power = 0;
};
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

std::vector<Waves> wavesOf(std::size_t rays)
{
    std::vector<Waves> waves(rays);
    for (std::size_t n = 0; n < rays; ++n) {
        const double t = 2 * std::numbers::pi * double(n) / double(rays);
        waves[n] = {1, std::cos(t), std::sin(t), std::cos(2 * t), std::sin(2 * t), std::cos(3 * t), std::sin(3 * t)};
    }
    return waves;
}

std::array<double, kPowers> powersOf(double along)
{
    std::array<double, kPowers> powers{1};
    for (std::size_t n = 1; n < kPowers; ++n)
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

double dotOf(const Waves& a, const Waves& b)
{
    double sum = 0;
    for (std::size_t n = 0; n < kWaves; ++n)
        sum += a[n] * b[n];
    return sum;
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

/// The least squares' fit. Waves are summed up ring by ring, as all of a ring's points have the same powers.
Terms fitOnce(const std::vector<WallRing>& wall, const std::vector<Waves>& waves, const std::vector<double>& weights)
{
    Matrix matrix{};
    Terms right{};
    for (std::size_t n = 0; n < wall.size(); ++n) {
        std::array<Waves, kWaves> of_waves{};
        Waves of_radii{};
        for (std::size_t r = 0; r < waves.size(); ++r) {
            const double weight = weights[n * waves.size() + r];
            if (weight <= 0)
                continue;
            for (std::size_t a = 0; a < kWaves; ++a) {
                const double weighted = weight * waves[r][a];
                of_radii[a] += weighted * wall[n].radii_mm[r];
                for (std::size_t b = 0; b <= a; ++b)
                    of_waves[a][b] += weighted * waves[r][b];
            }
        }
        const auto powers = powersOf(wall[n].along);
        for (std::size_t a = 0; a < kTerms; ++a) {
            right[a] += powers[kTerm[a].power] * of_radii[kTerm[a].wave];
            for (std::size_t b = 0; b <= a; ++b)
                matrix[a][b] +=
                    powers[kTerm[a].power] * powers[kTerm[b].power] * of_waves[kTerm[a].wave][kTerm[b].wave];
        }
    }
    return solved(matrix, right);
}

struct Robust {
    Terms fit{};
    double spread_mm = 0;
};

double quantile(std::vector<double> values, double share)
{
    if (values.empty())
        return 0;
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// What the wall deviates from the fit, ray by ray, where it is certain at all.
std::vector<double> deviations(const std::vector<WallRing>& wall, const std::vector<Waves>& waves, const Terms& fit)
{
    std::vector<double> deviations_mm;
    deviations_mm.reserve(wall.size() * waves.size());
    for (const WallRing& ring : wall) {
        const Waves fitted = onRing(fit, ring.along);
        for (std::size_t r = 0; r < waves.size(); ++r)
            if (ring.certainty[r] > 0)
                deviations_mm.push_back(std::abs(ring.radii_mm[r] - dotOf(fitted, waves[r])));
    }
    return deviations_mm;
}

/// Weights of all rays, ring by ring: those near the middle of the stretch count, those far from the fit do not.
std::vector<double> weightsOf(const std::vector<WallRing>& wall, const std::vector<Waves>& waves,
                              const std::vector<double>& deviations_mm, double limit_mm)
{
    std::vector<double> weights(wall.size() * waves.size(), 0);
    auto deviation_mm = deviations_mm.begin();
    for (std::size_t n = 0; n < wall.size(); ++n) {
        const double fading = std::pow(std::max(0.0, 1 - std::pow(std::abs(wall[n].along), 3)), 3);
        for (std::size_t r = 0; r < waves.size(); ++r)
            if (const double certainty = wall[n].certainty[r]; certainty > 0) {
                const double u = std::min(*deviation_mm++ / limit_mm, 1.0);
                weights[n * waves.size() + r] = certainty * fading * (1 - u * u) * (1 - u * u);
            }
    }
    return weights;
}

/// By how much the section in the middle of the stretch differs, at most, along any ray.
double differenceOf(const Terms& a, const Terms& b)
{
    double sum = 0;
    for (std::size_t n = 0; n < kTerms; ++n)
        if (kTerm[n].power == 0)
            sum += std::abs(a[n] - b[n]);
    return sum;
}

/// Tukey's biweight, from a circle on: folds and openings end up without weight.
Robust fitted(const std::vector<WallRing>& wall)
{
    const std::vector<Waves> waves = wavesOf(wall.front().radii_mm.size());
    Robust out{.fit = {quantile(deviations(wall, waves, {}), kStartQuantile)}};  // of the radii themselves
    for (int round = 0; round < kRounds; ++round) {
        const std::vector<double> deviations_mm = deviations(wall, waves, out.fit);
        out.spread_mm = 1.48 * quantile(deviations_mm, 0.5);
        const double limit_mm = kTight * std::max(kLeastSpread_mm, out.spread_mm);
        const Terms before = out.fit;
        out.fit = fitOnce(wall, waves, weightsOf(wall, waves, deviations_mm, limit_mm));
        if (differenceOf(out.fit, before) < kSettled_mm)
            break;
    }
    return out;
}

/// The centroid of the fitted section in the middle of the stretch, across the line.
std::array<double, 2> centroid(const Terms& fit)
{
    constexpr int kAngles = 64;
    static const std::vector<Waves> kAll = wavesOf(kAngles);
    const Waves ring = onRing(fit, 0);
    double area = 0, x = 0, y = 0;
    for (const Waves& waves : kAll) {
        const double d = std::max(dotOf(ring, waves), 0.0);
        area += d * d / 2;
        x += d * d * d / 3 * waves[1];
        y += d * d * d / 3 * waves[2];
    }
    return area > 0 ? std::array{x / area, y / area} : std::array{0.0, 0.0};
}

}  // namespace

SectionFit fitSection(const std::vector<WallRing>& wall)
{
    const Robust robust = fitted(wall);
    return {centroid(robust.fit), robust.fit[0], robust.spread_mm};
}

}  // namespace vicon::steps
