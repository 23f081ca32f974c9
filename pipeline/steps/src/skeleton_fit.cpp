#include "skeleton_fit.h"

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

constexpr std::size_t kTerms = 12;
using Terms = std::array<double, kTerms>;

struct Row {
    Terms terms{};
    double radius_mm = 0;
    double share = 0;  ///< of the stretch's weight, which fades outwards
};

std::vector<Row> rowsOf(const std::vector<WallPoint>& wall)
{
    std::vector<Row> rows;
    rows.reserve(wall.size());
    for (const WallPoint& p : wall) {
        const double s = p.along, c = std::cos(p.angle), d = std::sin(p.angle);
        rows.push_back({{1, s, c, s * c, s * s * c, d, s * d, s * s * d, c * c - d * d, 2 * c * d, c * (4 * c * c - 3),
                         d * (3 - 4 * d * d)},
                        p.radius_mm,
                        std::pow(std::max(0.0, 1 - std::abs(s * s * s)), 3)});
    }
    return rows;
}

/// Solves the normal equations by Cholesky's method. The small ridge decides what the wall leaves open.
Terms solved(std::array<Terms, kTerms>& m, Terms right)
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

double valueOf(const Terms& fit, const Terms& at)
{
    double sum = 0;
    for (std::size_t n = 0; n < kTerms; ++n)
        sum += fit[n] * at[n];
    return sum;
}

Terms fitOnce(const std::vector<Row>& wall, const std::vector<double>& weights)
{
    std::array<Terms, kTerms> matrix{};
    Terms right{};
    for (std::size_t n = 0; n < wall.size(); ++n) {
        if (weights[n] <= 0)
            continue;
        for (std::size_t r = 0; r < kTerms; ++r) {
            const double weighted = weights[n] * wall[n].terms[r];
            right[r] += weighted * wall[n].radius_mm;
            for (std::size_t c = 0; c <= r; ++c)
                matrix[r][c] += weighted * wall[n].terms[c];
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
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Tukey's biweight, from a circle on: folds and openings end up without weight.
Robust fitted(const std::vector<Row>& wall)
{
    std::vector<double> residuals(wall.size()), weights(wall.size());
    for (std::size_t n = 0; n < wall.size(); ++n)
        residuals[n] = wall[n].radius_mm;
    Robust out{.fit = {quantile(residuals, kStartQuantile)}};
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t n = 0; n < wall.size(); ++n)
            residuals[n] = std::abs(wall[n].radius_mm - valueOf(out.fit, wall[n].terms));
        out.spread_mm = 1.48 * quantile(residuals, 0.5);
        const double limit = kTight * std::max(kLeastSpread_mm, out.spread_mm);
        for (std::size_t n = 0; n < wall.size(); ++n) {
            const double u = residuals[n] / limit;
            weights[n] = u < 1 ? wall[n].share * (1 - u * u) * (1 - u * u) : 0;
        }
        out.fit = fitOnce(wall, weights);
    }
    return out;
}

/// The centroid of the fitted section in the middle of the stretch, across the line.
std::array<double, 2> centroid(const Terms& fit)
{
    constexpr int kAngles = 64;
    double area = 0, x = 0, y = 0;
    for (int n = 0; n < kAngles; ++n) {
        const double t = 2 * std::numbers::pi * n / kAngles;
        const double r = fit[0] + fit[2] * std::cos(t) + fit[5] * std::sin(t) + fit[8] * std::cos(2 * t) +
                         fit[9] * std::sin(2 * t) + fit[10] * std::cos(3 * t) + fit[11] * std::sin(3 * t);
        const double d = std::max(r, 0.0);
        area += d * d / 2;
        x += d * d * d / 3 * std::cos(t);
        y += d * d * d / 3 * std::sin(t);
    }
    return area > 0 ? std::array{x / area, y / area} : std::array{0.0, 0.0};
}

}  // namespace

SectionFit fitSection(const std::vector<WallPoint>& wall)
{
    const Robust robust = fitted(rowsOf(wall));
    return {centroid(robust.fit), robust.fit[0], robust.spread_mm};
}

}  // namespace vicon::steps
