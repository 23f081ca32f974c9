#include "vicon/steps/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "quality/lumen_profile.h"
#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

constexpr int kAverage_mm = 10;  // half of the triangle over which a cross-section is averaged: the flood goes in steps

std::string text(const char* pattern, double value)
{
    std::array<char, 96> out{};
    std::snprintf(out.data(), out.size(), pattern, value);
    return out.data();
}

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

StretchQuality measureStretch(const std::string& name, double from_mm, double to_mm, const std::vector<double>& radii,
                              const LumenProfile& profile, const QualityOptions& options)
{
    StretchQuality q{.name = name, .from_mm = from_mm, .to_mm = to_mm};
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
    q.adequate = q.longest_collapsed_mm < options.longest_collapsed_mm;
    return q;
}

void add(std::string& reason, const std::string& more)
{
    reason += (reason.empty() ? "" : "; ") + more;
}

void judge(ScanQuality& quality, const QualityOptions& options)
{
    for (const StretchQuality& part : quality.parts)
        if (!part.adequate) {
            quality.whole.adequate = false;
            add(quality.reason, part.name + text(" collapsed over %.0f mm", part.longest_collapsed_mm));
        }
    if (quality.parts.empty() && !quality.whole.adequate)
        add(quality.reason, text("collapsed over %.0f mm", quality.whole.longest_collapsed_mm));
    const double length_mm = quality.whole.to_mm;
    if (length_mm < options.shortest_mm || length_mm > options.longest_mm) {
        quality.whole.adequate = false;
        add(quality.reason, text("a length of %.0f mm is not plausible for a whole colon", length_mm));
    }
    if (quality.noise_hu > options.usual_noise_hu)
        add(quality.reason, text("more noise than usual: %.0f HU", quality.noise_hu));
}

nlohmann::json measuresOf(const StretchQuality& q)
{
    const double length_mm = std::max(1.0, q.to_mm - q.from_mm);
    return {{"adequate", q.adequate},
            {"median_radius_mm", q.median_radius_mm},
            {"collapsed_mm", q.collapsed_mm},
            {"longest_collapsed_mm", q.longest_collapsed_mm},
            {"collapsed_fraction", std::min(1.0, q.collapsed_mm / length_mm)},
            {"volume_ml", q.volume_ml},
            {"fluid_ml", q.fluid_ml},
            {"fluid_fraction", q.volume_ml > 0 ? q.fluid_ml / q.volume_ml : 0}};
}

}  // namespace

ScanQuality measureQuality(const InsideVolume& inside, const Skeleton& skeleton, const ColonPartRanges& parts,
                           double noise_hu, const QualityOptions& options, Progress& progress)
{
    if (skeleton.empty())
        throw Error(ErrorCode::bad_input, "the quality of a scan without a skeleton cannot be measured");
    progress.check();
    const LumenProfile profile = profileOf(inside, skeleton);
    progress.check();
    ScanQuality quality;
    quality.noise_hu = noise_hu;
    const std::vector<double> radii = radiiAlong(skeleton, profile);
    quality.whole = measureStretch("", 0, skeleton.length_mm(), radii, profile, options);
    for (const ColonPartRange& range : parts)
        quality.parts.push_back(
            measureStretch(nameOf(range.part), range.from_mm, range.to_mm, radii, profile, options));
    judge(quality, options);
    progress.report(1, "quality");
    return quality;
}

nlohmann::json toJson(const ScanQuality& quality, const QualityOptions& options)
{
    nlohmann::json out = measuresOf(quality.whole);
    out["noise_hu"] = quality.noise_hu;
    out["reason"] = quality.reason;
    out["thresholds"] = vicon::toJson(options);
    nlohmann::json& parts = out["parts"] = nlohmann::json::array();
    for (const StretchQuality& part : quality.parts) {
        parts.push_back(measuresOf(part));
        parts.back()["name"] = part.name;
    }
    return out;
}

}  // namespace vicon::steps
