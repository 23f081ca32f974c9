#include "vicon/steps/given_fit.h"

#include <algorithm>
#include <array>
#include <vector>

#include "segment/body.h"
#include "segment/given/given_labels.h"

namespace vicon::steps {
namespace {

/// Voxels. No case recorded; reason: a share of them is known to 0.0007, far below kClearlyBetter.
constexpr std::size_t kEnoughSamples = 500000;
/// By so much more of it must be gas or fluid before a mirrored place is named.
constexpr double kClearlyBetter = 0.1;

std::vector<Point3> samplesOf(const InsideVolume& mask)
{
    const auto marked = std::size_t(std::count_if(mask.voxels.begin(), mask.voxels.end(), [](auto v) { return v; }));
    const std::size_t every = marked / kEnoughSamples + 1;
    std::vector<Point3> samples;
    for (std::size_t n = 0, seen = 0; n < mask.voxels.size(); ++n)
        if (mask.voxels[n] && seen++ % every == 0)
            samples.push_back(mask.grid.pointAt(mask.grid.indexOf(n)));
    return samples;
}

/// A mirroring: x, y and z are kept or turned about a point.
struct Mirroring {
    std::string words;
    Vector3 sign;
    Point3 about;

    Point3 of(Point3 p) const
    {
        const Vector3 d = p - about;
        return about + Vector3{sign.x * d.x, sign.y * d.y, sign.z * d.z};
    }
};

std::vector<Mirroring> mirrorings(Point3 middle)
{
    return {{"left and right swapped", {-1, 1, 1}, middle},
            {"front and back swapped", {1, -1, 1}, middle},
            {"head and feet swapped", {1, 1, -1}, middle},
            {"left and right, front and back swapped", {-1, -1, 1}, middle},
            {"its RAS coordinates read as LPS, or the other way round", {-1, -1, 1}, Point3{}}};
}

struct Shares {
    double in_scan = 0, gas = 0, fluid = 0;
};

Shares sharesOf(const HuVolume& volume, const Body& body, const std::vector<Point3>& samples,
                const Mirroring& mirroring, double wall_hu, double fluid_hu)
{
    std::size_t in_scan = 0, gas = 0, fluid = 0;
    for (const Point3 sample : samples) {
        const Index3 v = volume.grid.indexAt(mirroring.of(sample));
        if (!volume.grid.contains(v) || volume.at(v) == kPaddingHu)
            continue;
        ++in_scan;
        const std::int16_t hu = volume.at(v);
        if (hu < wall_hu)
            gas += body.holds(v.j, v.k, v.i / body.factor) ? 1 : 0;
        else
            fluid += hu >= fluid_hu ? 1 : 0;
    }
    const double all = std::max<double>(1, double(in_scan));
    return {double(in_scan) / double(std::max<std::size_t>(1, samples.size())), double(gas) / all, double(fluid) / all};
}

}  // namespace

GivenFit fitOf(const HuVolume& volume, const InsideVolume& mask, Point3 middle_mm, const SegmentOptions& options,
               Progress& progress)
{
    const Body body = findBody(volume, progress);
    const std::vector<Point3> samples = samplesOf(mask);
    const auto shares = [&](const Mirroring& mirroring) {
        progress.check();
        return sharesOf(volume, body, samples, mirroring, options.densities.wall_hu, fluidFrom_hu(options));
    };
    const Shares own = shares({"", {1, 1, 1}, Point3{}});
    GivenFit fit{.in_scan = own.in_scan, .gas = own.gas, .fluid = own.fluid};
    const double marked = double(std::count_if(mask.voxels.begin(), mask.voxels.end(), [](auto v) { return v; }));
    fit.of_scan = own.in_scan * marked * mask.grid.voxelVolume_mm3() /
                  (double(volume.grid.voxelCount()) * volume.grid.voxelVolume_mm3());
    double best = fit.gasOrFluid() + kClearlyBetter;
    for (const Mirroring& mirroring : mirrorings(middle_mm)) {
        const Shares other = shares(mirroring);
        // Little of it in the scan says nothing.
        if (const double there = (other.gas + other.fluid) * other.in_scan; there > best) {
            best = there;
            fit.mirrored = mirroring.words;
            fit.mirrored_fit = there;
        }
    }
    return fit;
}

}  // namespace vicon::steps
