#include "polyp_figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vicon {
namespace {

// What follows was chosen on 1,986 outlined synthetic polyps: 4 to 30 mm, on planes, in tubes and in bends, at a blur
// of 0.5 to 0.9 mm and a noise of 0 to 80 HU (chain_polyp_size_test's scenes, seeds 91001 to 95540).

/// The tissue step's evening out along the wall, as a blur: it rounds corners too.
constexpr double kSmoothed_mm = 0.5;
/// How far a corner moves outwards along the wall, in blurs; what the head's height adds, as a low one has no corner of
/// two long sides; and what a rising wall takes from that.
constexpr double kCorner = 0.281, kLow = 0.44, kLowOnRise = 0.13;
/// And what a rim adds that runs steeply: its corner lies askew in the section. Chosen on 566 more, 15 to 30 mm,
/// sessile and flat (seeds 655000 to 670143), of which those inside of bends were 0.1 to 0.5 mm too long.
constexpr double kSteepRim = 0.75;
/// The largest of 24 chords over a rough rim is too long by so much of its roughness: 24 normal deviates reach 1.95, a
/// chord has two ends, and the four beside a point deviate too. Not fitted.
constexpr double kLargestOfRough = 1.98;
/// The same of the four or so chords that differ in the best plane and those beside it: four deviates reach 1.03.
constexpr double kLargestInPlane = 1.05;
/// What noise adds: it moves the wall in long waves, which are no roughness. By its square, for the largest is taken.
constexpr double kLongerByNoise = 6.2e-5;
// Eight in ten diameters err by less: a part that is always there, the rim's roughness, noise, and on the wall part of
// what low heads and rising walls are corrected by, and what grows with the square of the chord, over which no wall is
// even.
constexpr double kAlways_mm = 0.07, kOfNoise = 0.0048, kOfNoiseOnStalk = 0.0038;
constexpr double kOfRough = 0.78, kOfRoughOnStalk = 0.52;
constexpr double kOfLow = 0.133, kOfRise = 0.49, kOfSteepRim = 0.8, kOfChord_per_mm = 2.7e-4;
/// Below 6.5 mm blur leaves less of a head than these say: the interval is wider by so much, fully a millimetre below.
constexpr double kWiderOfSmall = 0.45, kSmall_mm = 6.5;

/// What a volume on the wall gains: between the rim's cone and a wall that rises (a paraboloid's would be 1/4 of the
/// rise at the rim, which is less than behind it) and at the rounded corner, less what the rim lies outside of the
/// head; and what blur takes from small ones. On a stalk: the corner's skirt, and the shell that a ball lost all
/// around, the smallest more.
constexpr double kSag = 0.208, kRounded = 0.559, kBeyondHead = 0.077, kOfSmallHead = 0.373;
constexpr double kSkirt = 0.447, kShell = 1.06, kOfSmallBall = 113;
/// Parts that eight in ten volumes err by: by blur in small heads, by the size of large ones, below which the wall's
/// course is not seen, and on the wall by rough rims and by noise; on a stalk some always.
constexpr double kVolumeOfBlur = 0.29, kVolumeOfRough = 0.183, kVolumeOfNoise = 0.0028;
/// The same, times the radius over the height: what the base is off by is much of a flat head. Chosen on 1,900 more,
/// 4 to 30 mm (seeds 604000 to 630431).
constexpr double kVolumeOfLarge = 0.03;
constexpr double kVolumeOnStalk = 0.0072, kVolumeOfBlurOnStalk = 0.154, kVolumeOfLargeOnStalk = 0.009;
constexpr double kLarge_mm = 10;  ///< radius
constexpr double kSizePower = 1.5;

constexpr double kLeastHeight_mm = 0.3;  // of a head; less is the wall's unevenness

double roundingBlur_mm(double blur_mm)
{
    return std::hypot(blur_mm, kSmoothed_mm);
}

double widerOfSmall(double diameter_mm)
{
    return 1 + kWiderOfSmall * std::clamp(kSmall_mm - diameter_mm, 0.0, 1.0);
}

/// What blur and noise made of a head, for all that is corrected.
struct Distorted {
    const TracedPolyp& polyp;
    double blur_mm = 0;
    double noise_hu_mm2 = 0;  ///< times the square of the blur: so it moves a wall
    double roughness_mm = 0;
    double height_mm = 0;      ///< as it is seen
    double wall_rise_rad = 0;  ///< wallRise_rad()

    /// How much longer a chord is than over a head as high as wide, and on a flat wall; with both ends on the wall.
    double low_mm(const HeadChord& chord) const
    {
        const double rounding = roundingBlur_mm(blur_mm);
        return chord.onWall() ? 2 * kLow * rounding * rounding / height_mm : 0;
    }
    double onRise_mm(const HeadChord& chord) const
    {
        return chord.onWall() ? -kLowOnRise * roundingBlur_mm(blur_mm) * wall_rise_rad * chord.length_mm / height_mm
                              : 0;
    }
    double onSteepRim_mm(const HeadChord& chord) const
    {
        return chord.onWall() ? kSteepRim * roundingBlur_mm(blur_mm) * rimSlope2(polyp, chord) : 0;
    }
    /// A chord before the blur. A surface moves by blur² times its mean curvature, 2 / diameter on a ball; at the rim,
    /// where one of the two is that of a corner, by half of that, and the corner itself moves outwards.
    double unblurred_mm(const HeadChord& chord, double of_rough = kLargestOfRough) const
    {
        const double shrunk = (4 - chord.ends_at_rim) * blur_mm * blur_mm / std::max(chord.length_mm, 1.0);
        return chord.length_mm + shrunk - chord.ends_at_rim * kCorner * roundingBlur_mm(blur_mm) - low_mm(chord) -
               onRise_mm(chord) - onSteepRim_mm(chord) - of_rough * roughness_mm -
               kLongerByNoise * noise_hu_mm2 * noise_hu_mm2;
    }
    double within_mm(const HeadChord& chord) const
    {
        if (!chord.onWall())
            return std::hypot(kAlways_mm, kOfRoughOnStalk * roughness_mm, kOfNoiseOnStalk * noise_hu_mm2);
        const double corrected =
            std::hypot(kOfLow * low_mm(chord), kOfRise * onRise_mm(chord), kOfSteepRim * onSteepRim_mm(chord));
        const double seen = std::hypot(kAlways_mm, kOfRough * roughness_mm, kOfNoise * noise_hu_mm2);
        return std::hypot(seen, corrected, kOfChord_per_mm * chord.length_mm * chord.length_mm);
    }
};

Distorted distortedOf(const TracedPolyp& polyp, const BlurAndNoise& scan)
{
    const std::vector<Point3> rim = polyp.rimPoints();
    double height_mm = 0;
    for (const Point3& p : rim)
        height_mm += dot(polyp.top - p, polyp.axis) / double(rim.size());
    return {polyp,
            scan.blur_mm,
            scan.noise_hu * scan.blur_mm * scan.blur_mm,
            roughness_mm(rim),
            std::max(height_mm, kLeastHeight_mm),
            wallRise_rad(polyp)};
}

void addVolume(PolypSize& size, const HeadChord& chord, const Distorted& by, double seen_mm3)
{
    constexpr double kMm3OfMl = 1000;
    const double rounding = roundingBlur_mm(by.blur_mm), radius_mm = size.diameter_mm / 2;
    const double of_blur = rounding / std::pow(radius_mm, kSizePower);
    const double of_size = std::pow(radius_mm / kLarge_mm, kSizePower);
    double added_mm = 0, part = 0;  // over the head's base; of the volume
    if (chord.onWall()) {
        added_mm = kSag * by.wall_rise_rad * radius_mm + kRounded * std::sqrt(rounding * by.height_mm) -
                   kBeyondHead * radius_mm + kOfSmallHead * rounding * rounding / radius_mm;
        part = std::hypot(std::hypot(kVolumeOfBlur * of_blur, kVolumeOfRough * by.roughness_mm / by.height_mm),
                          kVolumeOfNoise * by.noise_hu_mm2 / radius_mm,
                          kVolumeOfLarge * of_size * radius_mm / by.height_mm);
    } else {
        added_mm = chord.ends_at_rim * kSkirt * rounding + kShell * by.blur_mm * by.blur_mm / size.diameter_mm +
                   kOfSmallBall * std::pow(rounding, 4) / std::pow(size.diameter_mm, 3);
        part = std::hypot(kVolumeOnStalk, kVolumeOfBlurOnStalk * of_blur, kVolumeOfLargeOnStalk * of_size);
    }
    size.volume_ml = std::max(0.0, seen_mm3 + std::numbers::pi * radius_mm * radius_mm * added_mm) / kMm3OfMl;
    size.volume_least_ml = std::max(0.0, size.volume_ml * (1 - part));
    size.volume_most_ml = size.volume_ml * (1 + part);
}

void shortenTo(double length_mm, const HeadChord& chord, Point3& from, Point3& to)
{
    const Vector3 trim = normalized(chord.to - chord.from) * ((chord.length_mm - length_mm) / 2);
    from = chord.from + trim;
    to = chord.to - trim;
}

}  // namespace

PolypSize figuresOf(const TracedPolyp& polyp, const HeadChord& chord, Point3 middle, const BlurAndNoise& scan)
{
    const Distorted by = distortedOf(polyp, scan);
    const double blur_mm = scan.blur_mm;
    PolypSize size;
    size.diameter_mm = std::max(by.unblurred_mm(chord), chord.length_mm / 2);
    shortenTo(size.diameter_mm, chord, size.from_mm, size.to_mm);
    const double within_mm = widerOfSmall(size.diameter_mm) * by.within_mm(chord);
    size.least_mm = std::max(0.0, size.diameter_mm - within_mm);
    size.most_mm = size.diameter_mm + within_mm;
    // The rim that stands on the wall was raised as much as it moved outwards, the head made lower.
    const double raised_mm = chord.ends_at_rim * kCorner * roundingBlur_mm(blur_mm) / 2;
    const double shrunk_mm = 2 * blur_mm * blur_mm / std::max(size.diameter_mm, 1.0);
    size.height_mm = dot(polyp.top - middle, polyp.axis) + raised_mm + shrunk_mm;
    addVolume(size, chord, by, seenVolume_mm3(polyp, middle));
    size.rim_mm = polyp.rimPoints();
    return size;
}

std::optional<PlaneSize> bestPlaneOf(const TracedPolyp& polyp, const PolypSize& size,
                                     const std::array<Vector3, 3>& axes, const BlurAndNoise& scan)
{
    constexpr double kBetween_mm = 0.5;  // planes: less than voxels are
    const Distorted by = distortedOf(polyp, scan);
    const int reach = int(std::ceil(2 * size.most_mm / kBetween_mm));
    HeadChord best;
    HeadCut cut_of_best;
    Vector3 normal;
    for (const Vector3& axis : axes)
        for (int n = -reach; n <= reach; ++n) {
            HeadCut cut = cutOf(polyp, axis, n * kBetween_mm);
            if (const HeadChord chord = cut.largest(); chord.length_mm > best.length_mm) {
                best = chord;
                cut_of_best = std::move(cut);
                normal = axis;
            }
        }
    if (best.length_mm <= 0)
        return std::nullopt;
    PlaneSize plane;
    plane.diameter_mm =
        std::min(std::max(by.unblurred_mm(best, kLargestInPlane), best.length_mm / 2), size.diameter_mm);
    shortenTo(plane.diameter_mm, best, plane.from_mm, plane.to_mm);
    plane.middle_mm = interpolate(plane.from_mm, plane.to_mm, 0.5);
    plane.along = normalized(plane.to_mm - plane.from_mm);
    plane.up = cross(normal, plane.along);
    if (dot(plane.up, polyp.axis) < 0)
        plane.up = plane.up * -1;
    plane.area_mm2 = cut_of_best.area_mm2(plane.middle_mm, plane.along, plane.up);
    return plane;
}

}  // namespace vicon
