#include "vicon/phantom/posture_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "curve.h"
#include "openness.h"
#include "posture_warp.h"
#include "random.h"

namespace vicon::phantom {
namespace {

using std::numbers::pi;
constexpr double kShortestOfPair_mm = 1500, kLongest_mm = 1900;  // as the phantom's courses
constexpr int kAngles = 36;
constexpr double kLeastDistension = 0.6, kMostDistension = 1.5;  // of one posture beside the other
constexpr double kNarrowestOfPair_mm = 8.5, kWidest_mm = 34;
constexpr double kMostTurn = 80 * pi / 180;
constexpr double kMissingFold = 1.0 / 12;
constexpr double kShortEnd_mm = 10;
constexpr int kPairStep_mm = 5;  // of the widths that the step quality keeps
constexpr int kAverage_mm = 10;  // half of the triangle that it averages over
// Of the marks that are found in scans, about where they are (docs/evaluation/lumen-and-centreline.md), and of the wall
// that slides past the places where the colon is held.
constexpr std::array<double, 4> kMarkError_mm{8, 18, 8, 5};
constexpr double kSlide_mm = 6;
constexpr double kWildMark = 0.03;  // of the marks are another bend
constexpr double kWildMark_mm = 80;
constexpr double kClearanceNoise_mm = 1.4;  // the centreline is not quite in the middle
constexpr double kWidthNoise = 0.08;        // of the width: cross-sections of a bent colon are not planes
// Of a ray's length, one beside the other, its logarithm, which varies from bend to bend; and of the frame, which
// follows the centreline's bends. With these the relief of one place in two postures correlates as in whole scans.
constexpr double kRayNoise = -3.6, kRayNoiseVaries = 1.0;
constexpr double kAside_mm = 0.55;  // of the middle
constexpr double kFrameNoise = 25 * pi / 180;
// Sharp bends, which a posture has of its own: the frame turns, and planes across the centreline cross.
constexpr int kBends = 6;
constexpr double kBend_mm = 30, kMostBendTurn = 120 * pi / 180, kBendNoise = 2.5;
constexpr double kAlong_mm = 0.5;  // that planes across a found centreline lie off along the way

/// A smooth wander of about `reach_mm`, standard deviation 1.
std::vector<double> wander(Random& random, std::size_t count, double reach_mm)
{
    std::vector<double> knots(std::size_t(double(count) / reach_mm) + 5);
    for (double& knot : knots)
        knot = std::clamp(random.normal(), -2.5, 2.5) * 1.45;  // what the spline takes off
    std::vector<double> out(count);
    for (std::size_t n = 0; n < count; ++n)
        out[n] = splineValue(knots, double(n) / reach_mm + 1);
    return out;
}

/// What both postures share.
struct Patient {
    std::uint64_t seed;
    Relief relief;
    std::vector<double> radius_mm;  ///< at each mm
    std::array<double, 4> mark_mm;  ///< end of the rectum, begin of the descending colon, both flexures
};

Patient drawPatient(std::uint64_t seed)
{
    Random random(seed, "posture pair");
    const double length_mm = random.uniform(kShortestOfPair_mm, kLongest_mm), girth = random.uniform(0.95, 1.07);
    Patient patient{seed, drawRelief(seed, length_mm, 2, 0), {}, {}};
    std::vector<double> radii;
    for (const WayPoint& stop : usualWay())
        radii.push_back(stop.radius_mm * girth * random.uniform(0.92, 1.08));
    const auto count = std::size_t(length_mm) + 2;
    const std::vector<double> more = wander(random, count, 60);
    const double stops = double(radii.size() - 1);
    for (std::size_t n = 0; n < count; ++n)
        patient.radius_mm.push_back(splineValue(radii, double(n) / length_mm * stops) * (1 + 0.07 * more[n]));
    const WayMarks marks;
    patient.mark_mm = {marks.sigmoid / stops * length_mm, marks.descending / stops * length_mm,
                       marks.splenic_corner / stops * length_mm, marks.hepatic_corner / stops * length_mm};
    return patient;
}

/// Folds are not the same depth in every posture, and some are missing.
void varyFolds(Relief& relief, Random& random)
{
    std::vector<Fold> kept;
    for (Fold fold : relief.folds) {
        fold.depth_mm *= random.uniform(0.75, 1.25);
        if (random.uniform() >= kMissingFold)
            kept.push_back(fold);
    }
    relief.folds = std::move(kept);
}

std::vector<StationRange> drawBridges(Random& random, double length_mm)
{
    std::vector<StationRange> bridges;
    for (int n = random.below(4); n > 0; --n) {
        const double from = random.uniform(0.06, 0.94) * length_mm, to = from + random.uniform(10, 60);
        const bool clear = std::none_of(bridges.begin(), bridges.end(), [&](const StationRange& other) {
            return from < other.to_mm + 60 && to > other.from_mm - 60;
        });
        if (clear && to < length_mm - 40)
            bridges.push_back({from, to});
    }
    std::sort(bridges.begin(), bridges.end(), [](auto& a, auto& b) { return a.from_mm < b.from_mm; });
    return bridges;
}

using Radii = std::array<float, kAngles>;

/// Width, narrowest radius and all radii at each mm of a posture.
struct Sections {
    std::vector<double> area_mm2, narrowest_mm;
    std::vector<Radii> radius_mm;
};

Sections sectionsOf(const Relief& relief, const std::vector<double>& tube_mm)
{
    Sections out;
    std::size_t first_fold = 0, first_ring = 0;
    for (std::size_t n = 0; n < tube_mm.size(); ++n) {
        const double station_mm = double(n);
        while (first_fold < relief.folds.size() && relief.folds[first_fold].station_mm < station_mm - 24)
            ++first_fold;
        while (first_ring < relief.ring_mm.size() && relief.ring_mm[first_ring] < station_mm - 30)
            ++first_ring;
        std::vector<Fold> folds;
        for (std::size_t f = first_fold; f < relief.folds.size() && relief.folds[f].station_mm < station_mm + 24; ++f)
            if (std::abs(relief.folds[f].station_mm - station_mm) < 14)
                folds.push_back(relief.folds[f]);
        std::vector<double> rings;
        for (std::size_t r = first_ring; r < relief.ring_mm.size() && relief.ring_mm[r] < station_mm + 30; ++r)
            rings.push_back(relief.ring_mm[r]);
        double sum = 0, least = 1e9;
        Radii& radii = out.radius_mm.emplace_back();
        for (int a = 0; a < kAngles; ++a) {
            const double angle = 2 * pi * a / kAngles;
            const double tube = tube_mm[n] * haustration(relief, rings, station_mm, angle);
            const double radius = std::max(0.0, tube - foldDepth_mm(relief, folds, {station_mm, angle, tube, 0}));
            sum += radius * radius;
            least = std::min(least, radius);
            radii[std::size_t(a)] = float(radius);
        }
        out.area_mm2.push_back(sum * pi / kAngles);
        out.narrowest_mm.push_back(least);
    }
    return out;
}

std::vector<double> clearances(const Sections& sections, const std::vector<double>& noise)
{
    constexpr int kReach = 20;
    const int count = int(sections.narrowest_mm.size());
    std::vector<double> out(sections.narrowest_mm.size());
    for (int n = 0; n < count; ++n) {
        double least = 1e9;
        for (int m = std::max(0, n - kReach); m <= std::min(count - 1, n + kReach); ++m)
            least = std::min(least, std::hypot(sections.narrowest_mm[std::size_t(m)], double(m - n)));
        out[std::size_t(n)] = std::max(0.5, least + kClearanceNoise_mm * noise[std::size_t(n)]);
    }
    return out;
}

/// A frame beside that of the other posture, and how much rays are off in it, the logarithm.
struct Frames {
    std::vector<double> turn, noise;
};

Frames drawFrames(Random& random, std::size_t count)
{
    Frames frames{wander(random, count, 150), wander(random, count, 60)};
    for (std::size_t n = 0; n < count; ++n) {
        frames.turn[n] = kFrameNoise * frames.turn[n];
        frames.noise[n] = kRayNoise + kRayNoiseVaries * frames.noise[n];
    }
    for (int bend = 0; bend < kBends; ++bend) {
        const double at = random.uniform() * double(count), turn = random.uniform(-1, 1) * kMostBendTurn;
        for (std::size_t n = 0; n < count; ++n) {
            const double off = (double(n) - at) / kBend_mm;
            frames.turn[n] += turn * 0.5 * (1 + std::tanh(off));
            frames.noise[n] += kBendNoise * std::exp(-0.5 * off * off);
        }
    }
    return frames;
}

/// As rays from a centreline find them that is not quite in the middle, in a frame that wanders.
std::vector<Radii> reliefOf(const Sections& sections, Random& random)
{
    const std::size_t count = sections.radius_mm.size();
    const Frames frames = drawFrames(random, count);
    const std::vector<double> aside = wander(random, count, 7), up = wander(random, count, 7);
    std::vector<Radii> out(count);
    for (std::size_t a = 0; a < kAngles; ++a) {
        const double angle = 2 * pi * double(a) / kAngles;
        const std::vector<double> uneven = wander(random, count, 5);
        for (std::size_t n = 0; n < count; ++n) {
            const double at = double(a) + frames.turn[n] / (2 * pi) * kAngles + 4.0 * kAngles;
            const auto low = std::size_t(at);
            const Radii& radii = sections.radius_mm[n];
            const double radius =
                std::lerp(double(radii[low % kAngles]), double(radii[(low + 1) % kAngles]), at - double(low));
            const double off_mm = kAside_mm * (std::cos(angle) * aside[n] + std::sin(angle) * up[n]);
            out[n][a] =
                float(std::max(0.5, (radius - off_mm) * (1 + std::min(0.5, std::exp(frames.noise[n])) * uneven[n])));
        }
    }
    return out;
}

bool within(const std::vector<StationRange>& ranges, double station_mm)
{
    return std::any_of(ranges.begin(), ranges.end(),
                       [&](const auto& range) { return station_mm >= range.from_mm && station_mm <= range.to_mm; });
}

/// As the step quality keeps it.
LumenAlong widthsOf(const Sections& sections, const std::vector<StationRange>& bridges,
                    const std::vector<double>& noise)
{
    const int count = int(sections.area_mm2.size());
    std::vector<double> radii(sections.area_mm2.size(), 0);
    for (int n = 0; n < count; ++n) {
        double sum = 0, weights = 0;
        for (int m = std::max(0, n - kAverage_mm); m <= std::min(count - 1, n + kAverage_mm); ++m)
            if (!within(bridges, m)) {
                sum += (kAverage_mm + 1 - std::abs(m - n)) * sections.area_mm2[std::size_t(m)];
                weights += kAverage_mm + 1 - std::abs(m - n);
            }
        if (!within(bridges, n))
            radii[std::size_t(n)] = std::sqrt(sum / weights / pi) * (1 + kWidthNoise * noise[std::size_t(n)]);
    }
    LumenAlong along{.step_mm = kPairStep_mm, .radius_mm = {}, .fluid_fraction = {}, .collapsed = bridges};
    for (int n = 0; n < count; n += kPairStep_mm) {
        double sum = 0;
        const int to = std::min(n + kPairStep_mm, count);
        for (int m = n; m < to; ++m)
            sum += radii[std::size_t(m)];
        along.radius_mm.push_back(sum / (to - n));
        along.fluid_fraction.push_back(0);
    }
    return along;
}

ColonPartRanges foundParts(const Patient& patient, const PostureWarp& warp, double cut_mm, double length_mm,
                           Random& random)
{
    std::array<double, 4> marks{};
    for (std::size_t n = 0; n < marks.size(); ++n) {
        const double off =
            random.uniform() < kWildMark ? random.uniform(-1, 1) * kWildMark_mm : random.normal() * kMarkError_mm[n];
        marks[n] = warp.at(patient.mark_mm[n] + random.normal() * kSlide_mm) + off - cut_mm;
    }
    const double reach = WayMarks{}.flexure_mm;
    const std::array<double, 9> bounds{0,
                                       marks[0],
                                       marks[1],
                                       marks[2] - reach,
                                       marks[2] + reach,
                                       marks[3] - reach,
                                       marks[3] + reach,
                                       length_mm - 50,
                                       length_mm};
    ColonPartRanges parts;
    for (std::size_t n = 0; n + 1 < bounds.size(); ++n)
        parts.push_back({ColonPart(n), bounds[n], bounds[n + 1]});
    const bool ordered = std::is_sorted(bounds.begin(), bounds.end());
    return ordered ? parts : ColonPartRanges();  // as in a scan whose parts are not known
}

struct Drawn {
    PostureProfile profile;
    PostureWarp warp;  ///< stations of the profile
};

Drawn drawPosture(const Patient& patient, Position position)
{
    Random random(patient.seed, "posture", std::uint64_t(position));
    Relief relief = patient.relief;
    varyFolds(relief, random);
    const PostureWarp warp = freeWarp(halfLogStretch(patient.seed, position, relief.length_mm));
    relief = warped(relief, warp, random.uniform(-1, 1) * kMostTurn / 2);
    const auto count = std::size_t(relief.length_mm) + 1;

    const double most = std::log(kMostDistension) / 2, least = std::log(kLeastDistension) / 2;
    const std::vector<double> distension = wander(random, count, random.uniform(80, 200));
    const std::vector<StationRange> bridges = drawBridges(random, relief.length_mm);
    std::vector<double> tube(count, 0);
    for (std::size_t m = 0; m + 1 < patient.radius_mm.size(); ++m)  // of each place of the wall, where it comes to lie
        for (auto n = std::size_t(warp.station_mm[m]); n < count && double(n) <= warp.station_mm[m + 1] + 1; ++n) {
            const double factor = std::exp(std::clamp(0.12 * distension[n], least, most));
            tube[n] = std::clamp(patient.radius_mm[m] * factor, kNarrowestOfPair_mm, kWidest_mm) *
                      openness(bridges, double(n));
        }
    const Sections sections = sectionsOf(relief, tube);
    const std::vector<double> off_middle = wander(random, count, 7), uneven = wander(random, count, 15);
    const double cut_mm = random.uniform(0, kShortEnd_mm), end_mm = double(count) - 1 - random.uniform(0, kShortEnd_mm);

    // The centreline begins and ends within the lumen.
    const auto from = std::size_t(cut_mm), to = std::size_t(end_mm);
    const auto cropped = [&](const std::vector<double>& v) {
        return std::vector<double>(v.begin() + long(from), v.begin() + long(to) + 1);
    };
    Drawn drawn;
    PostureProfile& profile = drawn.profile;
    profile.length_mm = double(to - from);
    for (StationRange gap : bridges)
        profile.bridges.push_back({gap.from_mm - double(from), gap.to_mm - double(from)});
    const Sections shown{cropped(sections.area_mm2),
                         cropped(sections.narrowest_mm),
                         {sections.radius_mm.begin() + long(from), sections.radius_mm.begin() + long(to) + 1}};
    profile.clearance_mm = clearances(shown, cropped(off_middle));
    Random rays(patient.seed, "posture relief", std::uint64_t(position));
    profile.relief_mm = reliefOf(shown, rays);
    for (std::size_t n = 0; n < profile.clearance_mm.size(); ++n)
        if (within(profile.bridges, double(n))) {
            profile.clearance_mm[n] = 0;
            profile.relief_mm[n] = {};
        }
    profile.along = widthsOf(shown, profile.bridges, cropped(uneven));
    profile.parts = foundParts(patient, warp, double(from), profile.length_mm, random);
    drawn.warp = warp;
    const std::vector<double> slides = wander(rays, warp.station_mm.size(), 30);
    for (std::size_t n = 0; n < slides.size(); ++n)
        drawn.warp.station_mm[n] += kAlong_mm * slides[n] - double(from);
    return drawn;
}

}  // namespace

PosturePair drawPosturePair(std::uint64_t seed)
{
    const Patient patient = drawPatient(seed);
    Drawn first = drawPosture(patient, Position::supine), second = drawPosture(patient, Position::prone);
    PosturePair pair{std::move(first.profile), std::move(second.profile), {}, {}};
    for (std::size_t n = 0; double(n) <= patient.relief.length_mm; ++n) {
        const double here = first.warp.station_mm[n], there = second.warp.station_mm[n];
        if (here < 0 || there < 0 || here > pair.first.length_mm || there > pair.second.length_mm)
            continue;
        pair.first_mm.push_back(here);
        pair.second_mm.push_back(there);
    }
    return pair;
}

}  // namespace vicon::phantom
