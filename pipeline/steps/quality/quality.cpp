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

/// Millimetres along the skeleton that are collapsed, one after the other.
struct CollapsedRun {
    std::size_t from = 0, to = 0;
};

std::vector<CollapsedRun> collapsedRuns(const std::vector<double>& radii, const QualityOptions& options)
{
    std::vector<CollapsedRun> runs;
    for (std::size_t n = 0; n < radii.size(); ++n) {
        if (radii[n] >= options.collapsed_radius_mm)
            continue;
        if (runs.empty() || runs.back().to != n)
            runs.push_back({n, n});
        runs.back().to = n + 1;
    }
    return runs;
}

/// The longest run in a stretch of whole millimetres. One that goes on beyond it counts whole where most of it lies, of
/// halves where it begins, so that a border between parts hides none.
double longestRun_mm(const std::vector<CollapsedRun>& runs, std::size_t from, std::size_t to)
{
    std::size_t longest = 0;
    for (const CollapsedRun& run : runs) {
        const std::size_t first = std::max(run.from, from), last = std::min(run.to, to);
        if (first >= last)
            continue;
        const std::size_t here = 2 * (last - first), all = run.to - run.from;
        longest = std::max(longest, here > all || (here == all && first == run.from) ? all : last - first);
    }
    return double(longest);
}

StretchQuality measureStretch(std::optional<ColonPart> part, double from_mm, double to_mm,
                              const std::vector<double>& radii, const std::vector<CollapsedRun>& runs,
                              const LumenProfile& profile, const QualityOptions& options)
{
    StretchQuality q{.part = part};
    std::vector<double> sorted;
    // A millimetre belongs to the part in which it begins.
    const auto first = std::size_t(std::ceil(from_mm));
    const std::size_t last = std::min(radii.size(), std::size_t(std::ceil(to_mm)));
    for (std::size_t n = first; n < last; ++n) {
        q.volume_ml += profile.volume_mm3[n] / 1000;
        q.fluid_ml += profile.fluid_mm3[n] / 1000;
        sorted.push_back(radii[n]);
        q.collapsed_mm += radii[n] < options.collapsed_radius_mm ? 1 : 0;
    }
    q.longest_collapsed_mm = longestRun_mm(runs, first, last);
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

LumenAlong lumenAlong(const std::vector<double>& radii, const std::vector<CollapsedRun>& runs,
                      const LumenProfile& profile, double length_mm)
{
    LumenAlong along{.step_mm = kAlongStep_mm};
    for (const CollapsedRun& run : runs)
        along.collapsed.push_back({double(run.from), std::min(double(run.to), length_mm)});
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
    const std::vector<CollapsedRun> runs = collapsedRuns(radii, options);
    quality.whole = measureStretch(std::nullopt, 0, skeleton.length_mm(), radii, runs, profile, options);
    for (const ColonPartRange& range : parts)
        quality.parts.push_back(measureStretch(range.part, range.from_mm, range.to_mm, radii, runs, profile, options));
    addUntrusted(quality, untrusted, skeleton, parts);
    quality.along = lumenAlong(radii, runs, profile, skeleton.length_mm());
    quality.thresholds = vicon::toJson(options);
    judge(quality, skeleton.length_mm(), options);
    progress.report(1, "quality");
    return quality;
}

}  // namespace vicon::steps
