#include "skeleton/evened_line.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vicon::steps {

void KnownLine::add(const Polyline& more, double weight, double step_mm)
{
    if (!points.empty()) {
        const Point3 from = points.back();
        const int missing = int(std::lround(distance(from, more.front()) / step_mm)) - 1;
        for (int n = 1; n <= missing; ++n) {
            points.push_back(interpolate(from, more.front(), double(n) / (missing + 1)));
            weights.push_back(0);
        }
    }
    points.insert(points.end(), more.begin(), more.end());
    weights.insert(weights.end(), more.size(), weight);
}

double weightFor(double scale_mm, double step_mm)
{
    return std::pow(step_mm / scale_mm, 6);
}

// By its normal equations, whose matrix has three diagonals on either side of the middle.
Polyline evened(const KnownLine& known)
{
    // Geometry: the third difference, and the diagonals that its square fills.
    constexpr std::size_t kBand = 4;
    constexpr std::array<double, kBand> kThird{-1, 3, -3, 1};
    const std::size_t count = known.points.size();
    std::vector<std::array<double, kBand>> rows(count);  // [row][row - column]
    std::vector<Vector3> right(count);
    for (std::size_t n = 0; n < count; ++n) {
        rows[n][0] += known.weights[n];
        right[n] = (known.points[n] - Point3{}) * known.weights[n];
        for (std::size_t a = 0; n + 3 < count && a < kBand; ++a)
            for (std::size_t b = 0; b <= a; ++b)
                rows[n + a][a - b] += kThird[a] * kThird[b];
    }
    // Cholesky's method within the band.
    for (std::size_t r = 0; r < count; ++r)
        for (std::size_t off = std::min(r, kBand - 1) + 1; off-- > 0;) {
            const std::size_t c = r - off;
            double sum = rows[r][off];
            for (std::size_t k = r > kBand - 1 ? r - (kBand - 1) : 0; k < c; ++k)
                if (c - k < kBand)
                    sum -= rows[r][r - k] * rows[c][c - k];
            rows[r][off] = off == 0 ? std::sqrt(std::max(sum, 1e-12)) : sum / rows[c][0];
        }
    for (std::size_t r = 0; r < count; ++r) {
        for (std::size_t off = 1; off < kBand && off <= r; ++off)
            right[r] += right[r - off] * -rows[r][off];
        right[r] = right[r] / rows[r][0];
    }
    for (std::size_t r = count; r-- > 0;) {
        for (std::size_t off = 1; off < kBand && r + off < count; ++off)
            right[r] += right[r + off] * -rows[r + off][off];
        right[r] = right[r] / rows[r][0];
    }
    Polyline out;
    for (const Vector3& v : right)
        out.push_back(Point3{} + v);
    return out;
}

}  // namespace vicon::steps
