#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "segment_shapes.h"

/// Loops of the colon that are joined through holes in the walls between them.
namespace vicon::steps::test {

using Polyline = std::vector<Point3>;
using Shape = std::function<bool(Point3)>;

/// Limbs side by side along z with 1.5 mm of wall between them, joined in turn by a half circle at either end.
struct Limbs {
    double radius_mm = 6.5;
    double long_mm = 400;
    int count = 2;

    double pitch_mm() const { return 2 * radius_mm + 1.5; }
    double length_mm() const { return count * long_mm + (count - 1) * std::numbers::pi * pitch_mm() / 2; }
    Polyline line() const
    {
        Polyline points;
        for (int limb = 0; limb < count; ++limb) {
            const bool back = limb % 2 != 0;
            const double y = limb * pitch_mm(), to_z = back ? 0 : long_mm, half = pitch_mm() / 2;
            points.push_back({0, y, long_mm - to_z});
            points.push_back({0, y, to_z});
            for (int n = 1; n < 12 && limb + 1 < count; ++n) {
                const double angle = std::numbers::pi * n / 12;
                points.push_back({0, y + half * (1 - std::cos(angle)), to_z + (back ? -half : half) * std::sin(angle)});
            }
        }
        return points;
    }
    /// Distance from the middle of the nearest limb, where there is no bend.
    double fromMiddle(Point3 p) const
    {
        const double limb = std::clamp(std::round(p.y / pitch_mm()), 0.0, double(count - 1));
        return std::hypot(p.x, p.y - limb * pitch_mm());
    }
};

/// A window in the wall between a limb and the next.
struct Window {
    double wide_mm = 5.5;  ///< across the limbs
    double z_mm = 30;
    int limb = 0;
    double longer_mm = 0;  ///< along the limbs than it is wide

    bool holds(const Limbs& limbs, Point3 p) const
    {
        const double from_wall_mm = std::abs(p.y - (limb + 0.5) * limbs.pitch_mm());
        const double along_mm = std::max(0.0, std::abs(p.z - z_mm) - longer_mm / 2);
        return from_wall_mm < limbs.pitch_mm() / 2 && std::hypot(along_mm, p.x) < wide_mm / 2;
    }
};

/// What differs from plain limbs.
struct Loops {
    Limbs limbs;
    std::vector<Window> windows;
    Shape narrowed = [](Point3) { return false; };  ///< wall within the limbs
    Shape pouch = [](Point3) { return false; };     ///< lumen besides
    double pouch_mm = 0;                            ///< how far it goes towards -y
    double voxel_mm = 1;
    bool lying = false;  ///< the limbs lie in a slice, along x

    /// Between where a point is and where it would be if the limbs did not lie.
    Point3 turned(Point3 p) const { return lying ? Point3{p.z, p.y, p.x} : p; }
    InsideVolume draw() const
    {
        const double rim_mm = limbs.radius_mm + 3, ends_mm = limbs.pitch_mm() + rim_mm;
        const auto voxels = [&](double mm) { return int(std::ceil(mm / voxel_mm)); };
        Grid grid;
        grid.size = {voxels(2 * rim_mm), voxels((limbs.count - 1) * limbs.pitch_mm() + 2 * rim_mm + pouch_mm),
                     voxels(limbs.long_mm + 2 * ends_mm)};
        grid.spacing_mm = {voxel_mm, voxel_mm, voxel_mm};
        grid.origin_mm = {-rim_mm, -rim_mm - pouch_mm, -ends_mm};
        if (lying) {
            std::swap(grid.size[0], grid.size[2]);
            std::swap(grid.origin_mm.x, grid.origin_mm.z);
        }
        const Polyline line = limbs.line();
        return drawMask(grid, [&](Point3 at) {
            const Point3 p = turned(at);
            const bool in_window = std::any_of(windows.begin(), windows.end(),
                                               [&](const Window& window) { return window.holds(limbs, p); });
            return in_window || pouch(p) || (tubeDistance(line, limbs.radius_mm, p) < 0 && !narrowed(p));
        });
    }
};

inline Loops joinedBy(std::vector<Window> windows, Limbs limbs = {})
{
    Loops loops;
    loops.limbs = limbs;
    loops.windows = std::move(windows);
    return loops;
}

/// A limb that is 4 mm wide over 20 mm; a blind pouch begins where the colon has its width again.
inline Loops strictureBesideAPouch()
{
    Loops loops;
    loops.limbs.count = 1;
    loops.narrowed = [limbs = loops.limbs](Point3 p) { return std::abs(p.z - 200) < 10 && limbs.fromMiddle(p) > 2; };
    loops.pouch_mm = 90;
    loops.pouch = [](Point3 p) { return tubeDistance({{0, 0, 218}, {0, -75, 218}}, 6, p) < 0; };
    return loops;
}

/// A limb in which a fold leaves 14 of 30 mm; past it leads a ring 24 mm wide, with narrower mouths.
/// @param mouth_mm radius
inline Loops pouchPastAFold(double mouth_mm)
{
    Loops loops;
    loops.limbs = {.radius_mm = 15, .count = 1};
    loops.narrowed = [limbs = loops.limbs](Point3 p) { return std::abs(p.z - 200) < 2 && limbs.fromMiddle(p) > 7; };
    Polyline ring;
    for (int n = 0; n <= 24; ++n) {
        const double angle = std::numbers::pi * n / 24;
        ring.push_back({0, -15 - 60 * std::sin(angle), 200 - 40 * std::cos(angle)});
    }
    loops.pouch_mm = 90;
    loops.pouch = [=, wide = Polyline(ring.begin() + 4, ring.end() - 4)](Point3 p) {
        return tubeDistance({{0, 0, 160}, ring[3]}, mouth_mm, p) < 0 ||
               tubeDistance({{0, 0, 240}, ring[21]}, mouth_mm, p) < 0 || (p.y < -17 && tubeDistance(wide, 12, p) < 0);
    };
    return loops;
}

}  // namespace vicon::steps::test
