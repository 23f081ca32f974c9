#include "vicon/steps/quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "quality/lumen_profile.h"
#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

// Of the flood, not of a case: its steps are blocks of two voxels.
constexpr int kAverage_mm = 10;  // half of the triangle over which a cross-section is averaged: the flood goes in steps

/// Radius of the disc as large as the cross-section at each millimetre; 0 on bridges.
std::vector<double> radiiAlong(const Skeleton& skeleton, const LumenProfile& profile)
{
    const int count = int(profile.volume_mm3.size());
    std::vector<double> radii(profile.volume_mm3.size(), 0);
    std::vector<bool> bridged(radii.size());
    for (int n = 0; n < count; ++n)
        bridged[std::size_t(n)] = skeleton.onBridge(n + 0.5);
    for (int n = 0; n < count; ++n) {
        if (bridged[std::size_t(n)])
            continue;
        double sum = 0, weights = 0;
        for (int m = std::max(0, n - kAverage_mm); m <= std::min(count - 1, n + kAverage_mm); ++m)
            if (!bridged[std::size_t(m)]) {
                const double weight = kAverage_mm + 1 - std::abs(m - n);
                sum += weight * profile.volume_mm3[std::size_t(m)];
                weights += weight;
            }
        radii[std::size_t(n)] = std::sqrt(sum / weights / std::numbers::pi);
    }
    return radii;
}

StretchQuality measureStretch(std::optional<ColonPart> part, double from_mm, double to_mm,
                              const std::vector<double>& radii, const LumenProfile& profile,
                              const QualityOptions& options)
{
    StretchQuality q{.part = part};
    std::vector<double> sorted;
    double run_mm = 0;
    for (auto n = std::size_t(from_mm); n < radii.size() && double(n) < to_mm; ++n) {
        q.volume_ml += profile.volume_mm3[n] / 1000;
        q.fluid_ml += profile.fluid_mm3[n] / 1000;
        sorted.push_back(radii[n]);
        const bool collapsed = radii[n] < options.collapsed_radius_mm;
        q.collapsed_mm += collapsed;
        run_mm = collapsed ? run_mm + 1 : 0;
        q.longest_collapsed_mm = std::max(q.longest_collapsed_mm, run_mm);
    }
    if (!sorted.empty()) {
        const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        q.median_radius_mm = *middle;
    }
    q.collapsed_fraction = std::min(1.0, q.collapsed_mm / std::max(1.0, to_mm - from_mm));
    q.adequate = q.longest_collapsed_mm < options.longest_collapsed_mm;
    return q;
}

constexpr double kLeastMottled_ml = 0.5;  ///< a ball of 10 mm: less hides no lesion that matters

constexpr int kAlongStep_mm = 5;  ///< of what is kept along the skeleton: finer than the average over a cross-section

double rounded(double value, double parts_of_one)
{
    return std::round(value * parts_of_one) / parts_of_one;
}

std::vector<StationRange> collapsedAlong(const std::vector<double>& radii, double length_mm,
                                         const QualityOptions& options)
{
    std::vector<StationRange> out;
    bool open = true;
    for (std::size_t n = 0; n < radii.size(); ++n) {
        const bool collapsed = radii[n] < options.collapsed_radius_mm;
        if (collapsed && open)
            out.push_back({double(n), 0});
        if (collapsed)
            out.back().to_mm = std::min(double(n + 1), length_mm);
        open = !collapsed;
    }
    return out;
}

LumenAlong lumenAlong(const std::vector<double>& radii, const LumenProfile& profile, double length_mm,
                      const QualityOptions& options)
{
    LumenAlong along{.step_mm = kAlongStep_mm, .collapsed = collapsedAlong(radii, length_mm, options)};
    for (std::size_t from = 0; from < radii.size(); from += kAlongStep_mm) {
        const std::size_t to = std::min(from + kAlongStep_mm, radii.size());
        double radius = 0, volume = 0, fluid = 0;
        for (std::size_t n = from; n < to; ++n) {
            radius += radii[n];
            volume += profile.volume_mm3[n];
            fluid += profile.fluid_mm3[n];
        }
        along.radius_mm.push_back(rounded(radius / double(to - from), 10));
        along.fluid_fraction.push_back(volume > 0 ? rounded(fluid / volume, 100) : 0);
    }
    return along;
}

/// Each block of mottled tagging and each faint wall counts where the centreline is nearest to it.
void addUntrusted(ScanQuality& quality, const UntrustedWall& untrusted, const Skeleton& skeleton,
                  const ColonPartRanges& parts)
{
    const auto addAt = [&](Point3 p, auto add) {
        add(quality.whole);
        const double station_mm = skeleton.nearest(p).station_mm;
        for (std::size_t n = 0; n < parts.size(); ++n)
            if (station_mm >= parts[n].from_mm && (station_mm < parts[n].to_mm || n + 1 == parts.size())) {
                add(quality.parts[n]);
                break;
            }
    };
    const MottledTagging& mottled = untrusted.mottled;
    for (std::size_t block = 0; block < mottled.blocks_mm.size(); ++block)
        addAt(mottled.blocks_mm[block], [&](StretchQuality& of) { of.mottled_ml += mottled.volume_ml(block); });
    for (const FaintWall& wall : untrusted.faint)
        addAt(wall.middle_mm, [](StretchQuality& of) { ++of.faint_walls; });
}

void judge(ScanQuality& quality, double length_mm, const QualityOptions& options)
{
    const auto note = [&](QualityReason reason, std::optional<ColonPart> part, double value) {
        quality.notes.push_back({reason, part, value});
        quality.reason += (quality.reason.empty() ? "" : "; ") + textOf(quality.notes.back());
    };
    for (const StretchQuality& part : quality.parts)
        if (!part.adequate) {
            quality.whole.adequate = false;
            note(QualityReason::collapsed, part.part, part.longest_collapsed_mm);
        }
    if (quality.parts.empty() && !quality.whole.adequate)
        note(QualityReason::collapsed, {}, quality.whole.longest_collapsed_mm);
    if (length_mm < options.shortest_mm || length_mm > options.longest_mm) {
        quality.whole.adequate = false;
        note(QualityReason::implausible_length, {}, length_mm);
    }
    if (quality.noise_hu > options.usual_noise_hu)
        note(QualityReason::noise, {}, quality.noise_hu);
    const auto noteUntrusted = [&](const StretchQuality& of) {
        if (of.mottled_ml >= kLeastMottled_ml)
            note(QualityReason::mottled, of.part, of.mottled_ml);
        if (of.faint_walls > 0)
            note(QualityReason::faint_walls, of.part, of.faint_walls);
    };
    for (const StretchQuality& part : quality.parts)
        noteUntrusted(part);
    if (quality.parts.empty())
        noteUntrusted(quality.whole);
}

}  // namespace

ScanQuality measureQuality(const InsideVolume& inside, const Skeleton& skeleton, const ColonPartRanges& parts,
                           double noise_hu, const UntrustedWall& untrusted, const QualityOptions& options,
                           Progress& progress)
{
    if (skeleton.empty())
        throw Error(ErrorCode::bad_input, "the quality of a scan without a skeleton cannot be measured");
    progress.check();
    const LumenProfile profile = profileOf(inside, skeleton);
    progress.check();
    ScanQuality quality;
    quality.noise_hu = noise_hu;
    const std::vector<double> radii = radiiAlong(skeleton, profile);
    quality.whole = measureStretch(std::nullopt, 0, skeleton.length_mm(), radii, profile, options);
    for (const ColonPartRange& range : parts)
        quality.parts.push_back(measureStretch(range.part, range.from_mm, range.to_mm, radii, profile, options));
    addUntrusted(quality, untrusted, skeleton, parts);
    quality.along = lumenAlong(radii, profile, skeleton.length_mm(), options);
    quality.thresholds = vicon::toJson(options);
    judge(quality, skeleton.length_mm(), options);
    progress.report(1, "quality");
    return quality;
}

}  // namespace vicon::steps
