#include "skeleton/section.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "skeleton/section_fit.h"

namespace vicon::steps {
namespace {

// Chosen on phantoms 1, 3 and 301 to 305, full size, and on the four shapes of the reference data.
constexpr double kTangent_mm = 3;
constexpr double kStretch_mm = 26;     // of the curve on either side, fading outwards, for the fit: about one haustrum
constexpr double kMedianOver_mm = 25;  // of the curve, for the median of the radii per angle: passes over folds
constexpr std::size_t kSparse = 2;     // of so many points of the line one has a section; those between lie between
constexpr double kEnd_mm = 22;         // of the curve, at an end of which nothing is fitted for half that length
// Spread of the wall about the fit, in radii. Up to the first the fit counts alone, from the second on the median
// alone. Phantoms stay below 0.09 (99 % of the sections), the shapes reach 0.32.
constexpr double kRegular = 0.09, kIrregular = 0.13;

// Of the scanner (0.5 to 0.8 mm), of voxels 0.7 to 1 mm wide and of the mask made of them, together; chosen on phantoms
// 3 and 302 to 304.
constexpr double kBlur_mm = 0.8;
constexpr double kTightest = 0.9;  // of radius x curvature; at 1 the inner wall would be a point

// On the inner side of a bend sections crowd to 1 - radius x curvature of their distance: so much less wall does each
// ray stand for, and an error of the line's direction lets the ray meet wall that belongs so much farther along the
// line. The square of the latter is the variance of a radius where the lumen's width changes; together the third power.
// Without it the curves of phantoms 218 and 225 are 0.4 % short instead of 0.1 %.
constexpr double kLeastCrowded = 0.1;

using Radii = std::vector<std::vector<float>>;  // [section][ray]
using Shift = std::array<double, 2>;            // along the frame's u and v

Radii sampleRadii(const Polyline& line, const std::vector<Frame>& frames, const DistanceProbe& wall, int rays)
{
    Radii radii((line.size() + kSparse - 1) / kSparse, std::vector<float>(std::size_t(rays)));
    tbb::parallel_for(std::size_t(0), radii.size(), [&](std::size_t n) {
        const Point3 from = line[n * kSparse];
        const Frame& frame = frames[n * kSparse];
        const double limit_mm = 3 * wall.at(from) + 5;
        for (int r = 0; r < rays; ++r) {
            const double angle = 2 * std::numbers::pi * r / rays;
            const Vector3 along = frame.u * std::cos(angle) + frame.v * std::sin(angle);
            radii[n][std::size_t(r)] = float(reach(wall, from, along, limit_mm));
        }
    });
    return radii;
}

/// The sections about one of them.
struct SectionRange {
    std::size_t first = 0, last = 0;
};

SectionRange about(std::size_t middle, double half_mm, double apart_mm, std::size_t count)
{
    const auto half = std::size_t(half_mm / apart_mm);
    return {middle > half ? middle - half : 0, std::min(middle + half, count - 1)};
}

/// How far each ray of a section can be relied on.
Radii certainties(const Polyline& line, const std::vector<Frame>& frames, const Radii& radii, double step_mm)
{
    Radii certainty = radii;
    tbb::parallel_for(std::size_t(0), radii.size(), [&](std::size_t n) {
        const Vector3 bend = bendAt(line, n * kSparse, step_mm);
        const double towards_u = dot(bend, frames[n * kSparse].u), towards_v = dot(bend, frames[n * kSparse].v);
        for (std::size_t r = 0; r < radii[n].size(); ++r) {
            const double angle = 2 * std::numbers::pi * double(r) / double(radii[n].size());
            const double curvature = towards_u * std::cos(angle) + towards_v * std::sin(angle);
            const double crowded = std::clamp(1 - radii[n][r] * curvature, kLeastCrowded, 1.0);
            // From a point of a collapsed part, outside the lumen, no ray gets anywhere.
            certainty[n][r] = radii[n][r] > 0 ? float(crowded * crowded * crowded) : 0;
        }
    });
    return certainty;
}

/// The sections of a line.
struct Sections {
    double apart_mm = 0;
    Radii radii_mm, certainty;  ///< the latter only where they are fitted
};

SectionFit fitAt(std::size_t middle, const Sections& sections)
{
    const SectionRange stretch = about(middle, kStretch_mm, sections.apart_mm, sections.radii_mm.size());
    std::vector<WallRing> wall;
    for (std::size_t n = stretch.first; n <= stretch.last; ++n)
        wall.push_back({(double(n) - double(middle)) * sections.apart_mm / kStretch_mm, sections.radii_mm[n],
                        sections.certainty[n]});
    return fitSection(wall);
}

/// The centroid of the section whose radii are the medians, per angle, over a stretch.
Shift medianMiddle(std::size_t middle, const Sections& sections)
{
    const Radii& radii = sections.radii_mm;
    const SectionRange stretch = about(middle, kMedianOver_mm / 2, sections.apart_mm, radii.size());
    const std::size_t rays = radii[middle].size();
    double area = 0;
    Shift sum{};
    std::vector<float> along;
    for (std::size_t r = 0; r < rays; ++r) {
        along.clear();
        for (std::size_t n = stretch.first; n <= stretch.last; ++n)
            if (radii[n][r] > 0)
                along.push_back(radii[n][r]);
        if (along.empty())
            continue;
        const auto at = along.begin() + std::lround(0.5 * double(along.size() - 1));
        std::nth_element(along.begin(), at, along.end());
        const double angle = 2 * std::numbers::pi * double(r) / double(rays), d = *at;
        area += d * d / 2;
        sum[0] += d * d * d / 3 * std::cos(angle);
        sum[1] += d * d * d / 3 * std::sin(angle);
    }
    return area > 0 ? Shift{sum[0] / area, sum[1] / area} : Shift{};
}

/// From 1 where the fit describes the wall to 0 where the lumen is no tube of slowly changing section.
double trustIn(const SectionFit& fit)
{
    const double irregular = fit.spread_mm / std::max(fit.radius_mm, 1e-3);
    return std::clamp((kIrregular - irregular) / (kIrregular - kRegular), 0.0, 1.0);
}

/// From 0 at an end of the curve, where the stretch ends, to 1 far from it.
double trustSoNear(double end_mm)
{
    return std::clamp(2 * end_mm / kEnd_mm - 1, 0.0, 1.0);
}

/// A middle beside the line and how much of it is the fitted one; of the median's the rest.
struct Fitted {
    Shift middle_mm{};
    double trust = 0;
};

Fitted fittedAt(std::size_t n, const Sections& sections)
{
    const std::size_t to_end = std::min(n, sections.radii_mm.size() - 1 - n);
    const double near_end = trustSoNear(double(to_end) * sections.apart_mm);
    if (near_end <= 0)
        return {};
    const SectionFit fit = fitAt(n, sections);
    return {fit.middle_mm, near_end * trustIn(fit)};
}

Shift mixed(Shift a, Shift b, double t)
{
    return {std::lerp(a[0], b[0], t), std::lerp(a[1], b[1], t)};
}

Fitted middleAt(std::size_t n, const Sections& sections, Middle middle)
{
    Fitted out = middle == Middle::fitted ? fittedAt(n, sections) : Fitted{};
    if (out.trust < 1)
        out.middle_mm = mixed(medianMiddle(n, sections), out.middle_mm, out.trust);
    return out;
}

/// Where the lumen's middle lies beside each point of the line, and how much of that is the fitted one.
std::vector<Fitted> middles(const Polyline& line, const std::vector<Frame>& frames, const DistanceProbe& wall,
                            double step_mm, int rays, Middle middle)
{
    Sections sections{double(kSparse) * step_mm, sampleRadii(line, frames, wall, rays), {}};
    if (middle == Middle::fitted)
        sections.certainty = certainties(line, frames, sections.radii_mm, step_mm);
    const std::size_t count = sections.radii_mm.size();
    std::vector<Fitted> found(count);
    tbb::parallel_for(std::size_t(0), count, [&](std::size_t n) { found[n] = middleAt(n, sections, middle); });
    std::vector<Fitted> out(line.size());
    for (std::size_t n = 0; n < out.size(); ++n) {
        const Fitted &low = found[n / kSparse], &high = found[std::min(n / kSparse + 1, count - 1)];
        const double t = double(n % kSparse) / double(kSparse);
        out[n] = {mixed(low.middle_mm, high.middle_mm, t), std::lerp(low.trust, high.trust, t)};
    }
    return out;
}

/// How far the middle between the half-way densities of a bent tube lies on the inside of the bend. Blur of standard
/// deviation s moves the place of half-way density towards a surface's centre of curvature by s^2 / 2 times the sum of
/// its curvatures: outwards-bent wall on the outer side of the bend, a saddle on the inner. Of a torus, with a = radius
/// x curvature of the line, the first harmonic of that is s^2 / 2 x curvature x 2 / a^2 (1 / sqrt(1 - a^2) - 1).
/// Holds for a tube, so only where the fit does.
Vector3 blurInward(const Polyline& line, std::size_t n, const DistanceProbe& wall, double step_mm)
{
    const Vector3 bend = bendAt(line, n, step_mm);
    const double a = std::clamp(wall.at(line[n]) * length(bend), 0.05, kTightest);
    return bend * (kBlur_mm * kBlur_mm / 2 * 2 / (a * a) * (1 / std::sqrt(1 - a * a) - 1));
}

}  // namespace

double reach(const DistanceProbe& wall, Point3 from, Vector3 along, double limit_mm)
{
    const double voxel = wall.smallestSpacing_mm();
    double s = 0;
    while (s < limit_mm) {
        const double d = wall.at(from + along * s);
        if (d < 0.15 * voxel)
            break;
        s += std::max(0.9 * d, 0.15 * voxel);
    }
    return std::min(s, limit_mm);
}

Polyline recentred(const Polyline& line, const DistanceProbe& wall, double step_mm, int rays, Middle middle)
{
    const auto frames = framesAlong(line, std::size_t(std::max(1.0, kTangent_mm / step_mm)));
    const auto found = middles(line, frames, wall, step_mm, rays, middle);
    Polyline out(line.size());
    for (std::size_t n = 0; n < line.size(); ++n) {
        const auto& [x_mm, y_mm] = found[n].middle_mm;
        const Vector3 blur = blurInward(line, n, wall, step_mm) * found[n].trust;
        out[n] = keptInside(line[n] + frames[n].u * x_mm + frames[n].v * y_mm - blur, line[n], wall);
    }
    return out;
}

}  // namespace vicon::steps
