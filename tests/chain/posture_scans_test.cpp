// One colon in two postures, as whole scans through the pipeline's steps: are the same places found?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "vicon/cases/station_map.h"
#include "vicon/phantom/phantom.h"
#include "vicon/steps/colon_parts.h"
#include "vicon/steps/quality.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/skeleton.h"

namespace vicon {
namespace {

/// Nothing was chosen on these.
constexpr int kFirstSeed = 701, kPairs = 12;

struct Posture {
    Skeleton curve;
    ColonProfile profile;
    phantom::PhantomTruth truth;

    /// Where the found centreline passes a place of the patient's wall; nothing where the scan has no lumen there.
    std::optional<double> stationOf(double wall_mm) const
    {
        const auto at = std::lower_bound(truth.wall_mm.begin(), truth.wall_mm.end(), wall_mm);
        if (at == truth.wall_mm.end())
            return std::nullopt;
        const SkeletonPoint& point = truth.curve[std::size_t(at - truth.wall_mm.begin())];
        const SkeletonFoot foot = curve.nearest(point.position_mm);
        return point.radius_mm > 0 && foot.distance_mm < 15 ? std::optional(foot.station_mm) : std::nullopt;
    }
};

Posture postureOf(int seed, const char* position)
{
    NoProgress quiet;
    phantom::PhantomScan scan = phantom::makeScan(
        {.seed = std::uint64_t(seed), .size = {256, 256, 215}, .stretch = true, .gaps = 2}, position, quiet);
    const HuVolume volume = steps::resample(std::move(scan.hu), {}, quiet);
    steps::Segmentation found = steps::segmentColon(volume, scan.truth.gravity, {}, quiet);
    Posture posture;
    posture.curve = steps::findSkeleton(found.inside, found.plan, {}, quiet).curve;
    const ColonPartRanges parts = steps::findColonParts(posture.curve).ranges;
    const ScanQuality quality = steps::measureQuality(found.inside, posture.curve, parts, 0, {}, {}, quiet);
    posture.profile = profileOf(posture.curve, parts, quality.along);
    posture.profile.relief = reliefOf(found.inside, posture.curve);
    scan.truth.inside = {};
    posture.truth = std::move(scan.truth);
    return posture;
}

struct Place {
    double error_mm, plain_mm;
    bool held;
};

std::vector<Place> placesOf(const Posture& supine, const Posture& prone)
{
    const StationMap map = matchStations(supine.profile, prone.profile);
    EXPECT_EQ(map.source, MapSource::wall);
    std::vector<Place> places;
    for (double wall_mm = 5; wall_mm < supine.truth.wall_mm.back(); wall_mm += 5) {
        const auto here = supine.stationOf(wall_mm), there = prone.stationOf(wall_mm);
        if (!here || !there)
            continue;
        const StationInterval found = map.at(*here);
        const double plain = *here / supine.profile.length_mm * prone.profile.length_mm;
        places.push_back({std::abs(found.station_mm - *there), std::abs(plain - *there),
                          *there >= found.least_mm && *there <= found.most_mm});
    }
    return places;
}

double quantile(const std::vector<Place>& places, double Place::*what, double share)
{
    std::vector<double> values;
    for (const Place& place : places)
        values.push_back(place.*what);
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1, std::size_t(share * double(values.size())))];
}

double held(const std::vector<Place>& places)
{
    return double(std::count_if(places.begin(), places.end(), [](const Place& p) { return p.held; })) /
           double(places.size());
}

void print(const char* what, const std::vector<Place>& places)
{
    std::printf("%-10s | %4zu |", what, places.size());
    for (const auto value : {&Place::error_mm, &Place::plain_mm})
        for (const double share : {0.25, 0.5, 0.75, 0.95})
            std::printf(" %5.1f |", quantile(places, value, share));
    std::printf(" %4.1f %%\n", 100 * held(places));
}

TEST(PostureScans, AreMatchedBetterThanByThePlainFraction)
{
    std::printf("seed | places | map 25 | 50 | 75 | 95 %% | fraction 25 | 50 | 75 | 95 %% | held\n");
    std::vector<Place> all;
    for (int seed = kFirstSeed; seed < kFirstSeed + kPairs; ++seed) {
        const std::vector<Place> places = placesOf(postureOf(seed, "HFS"), postureOf(seed, "HFP"));
        print(std::to_string(seed).c_str(), places);
        std::fflush(stdout);
        all.insert(all.end(), places.begin(), places.end());
    }
    print("all", all);
    EXPECT_LE(quantile(all, &Place::error_mm, 0.5), 8);
    EXPECT_LE(quantile(all, &Place::error_mm, 0.95), 30);
    EXPECT_GE(held(all), 0.76);
    EXPECT_LE(held(all), 0.84);
    for (const double share : {0.25, 0.5, 0.75, 0.95})
        EXPECT_LT(quantile(all, &Place::error_mm, share), quantile(all, &Place::plain_mm, share)) << share;
}

}  // namespace
}  // namespace vicon
