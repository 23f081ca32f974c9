#include "ileum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "densities.h"
#include "random.h"
#include "vicon/core/error.h"

namespace vicon::phantom {
namespace {

constexpr double kWall_mm = 2, kStep_mm = 4, kApart_mm = 3;
constexpr double kShortest_mm = 100;
constexpr double kLowest_mm = 105;  // the pelvis is left to the rectum
constexpr double kNarrowest_mm = 5;
constexpr int kWays = 100, kTurns = 40;

/// Where the valve opens, and which way the ileum leaves.
struct Valve {
    Point3 mouth_mm;  ///< on the colon's inner surface
    Vector3 outward;
    double station_mm = 0;
    double wall_mm = 0;  ///< from the inner surface to the outside
};

/// The place on the medial wall, 22 to 83 mm before the end of the axis, where no fold stands: the widest.
Valve drawValve(const DrawnCourse& drawn, const Wall& wall, Random& random)
{
    const Course& course = drawn.course;
    const double middle_mm = course.length_mm() - random.uniform(30, 75), tilt = random.uniform(-1, 1);
    Valve best;
    double widest = 0;
    for (double station = middle_mm - 8; station <= middle_mm + 8; station += 1) {
        const CourseSample& at = course.samples[course.sampleAt(station)];
        const Vector3 medial{1, tilt, 0};
        const Vector3 outward = normalized(medial - at.tangent * dot(medial, at.tangent));
        const double angle = std::atan2(dot(outward, at.binormal), dot(outward, at.normal));
        const Wall::Sample here = wall.at(station, angle);
        if (here.lumen_mm > widest) {
            widest = here.lumen_mm;
            best = {at.position_mm + outward * here.lumen_mm, outward, station, here.outside_mm - here.lumen_mm};
        }
    }
    return best;
}

class Grower {
public:
    Grower(const DrawnCourse& drawn, const Valve& valve, double radius_mm)
        : drawn_(drawn), valve_(valve), radius_mm_(radius_mm)
    {
    }

    /// A way from the valve outwards, up to `length_mm` long; shorter where there is no room.
    std::vector<Point3> grow(double length_mm, double neck_mm, Random& random) const
    {
        std::vector<Point3> way{valve_.mouth_mm, valve_.mouth_mm + valve_.outward * neck_mm};
        Vector3 along = valve_.outward;
        for (double so_far = 0; so_far < length_mm; so_far += kStep_mm) {
            Point3 best = way.back();
            double most = -1;
            for (int n = 0; n < kTurns; ++n) {
                const Vector3 turned = normalized(along + 0.45 * anyDirection(random));
                const Point3 next = way.back() + turned * kStep_mm;
                const double room = roomAt(next, way);
                // Towards room, but not straight there, so that the next try finds another way.
                const double liking = std::min(room, 8.0) + random.uniform(0, 4);
                if (room >= 0 && liking > most) {
                    most = liking;
                    best = next;
                }
            }
            if (most < 0)
                break;
            along = normalized(best - way.back());
            way.push_back(best);
        }
        return way;
    }

private:
    /// How much farther than need be a point of the middle lies from all else, mm; below 0 where there is no room.
    double roomAt(Point3 p, const std::vector<Point3>& way) const
    {
        const double need = radius_mm_ + kWall_mm + kApart_mm;
        if (p.z < kLowest_mm || !inBelly(drawn_.trunk, p, radius_mm_ + kWall_mm))
            return -1;
        double room = 20;
        for (const Ellipsoid& organ : obstacles()) {
            const Solid solid{Solid::Kind::ellipsoid, organ.centre_mm, organ.centre_mm, organ.radii_mm, 0, false, 0};
            room = std::min(room, distanceTo(solid, p) - radius_mm_ - kWall_mm);
        }
        const double from_mouth = distance(p, valve_.mouth_mm);
        for (std::size_t n = 0; n < drawn_.course.samples.size(); n += 3) {
            const CourseSample& s = drawn_.course.samples[n];
            const bool beside = std::abs(drawn_.course.stationOf(n) - valve_.station_mm) < 40;
            // Next to the valve the ileum cannot be clear of the colon yet, only leave it.
            const double wanted = beside ? std::min(need, 0.8 * from_mouth - 14) : need;
            room = std::min(room, distance(p, s.position_mm) - s.radius_mm - 2 - wanted);
        }
        const auto own = std::size_t((2 * radius_mm_ + 12) / kStep_mm);
        for (std::size_t n = 0; n + own < way.size(); ++n)
            room = std::min(room, distance(p, way[n]) - 2 * radius_mm_ - 2 * kWall_mm - kApart_mm);
        return room;
    }

    const DrawnCourse& drawn_;
    const Valve& valve_;
    double radius_mm_;
};

Solid link(Point3 a, Point3 b, double radius_mm, double hu)
{
    return {Solid::Kind::capsule, a, b, {radius_mm, radius_mm, radius_mm}, hu, false, 0};
}

/// What fills the ileum: the pool that covers the valve, or gas with a level of its own.
void fill(Ileum& ileum, const std::vector<Point3>& way, const Valve& valve, const std::vector<FluidPool>& pools,
          Vector3 up, Random& random)
{
    const auto height = [&](Point3 p) { return dot(p - Point3{}, up); };
    double level = -1e9, density = random.uniform(300, 800);
    double middle = 0;
    for (const Point3 p : way)
        middle += height(p) / double(way.size());
    if (random.uniform() < 0.5)  // below the valve: above it would run into the colon
        level = std::min(middle, height(valve.mouth_mm) - ileum.truth.neck_radius_mm - 1);
    for (const FluidPool& pool : pools)
        if (valve.station_mm >= pool.from_mm && valve.station_mm <= pool.to_mm &&
            height(valve.mouth_mm) < pool.level_mm) {
            level = pool.level_mm;
            density = pool.density_hu;
        }
    for (Solid& solid : ileum.lumen) {
        solid.has_level = true;
        solid.level_mm = level;
        solid.density_hu = density;
    }
    ileum.truth.through_fluid = level > height(valve.mouth_mm);
}

}  // namespace

Ileum drawIleum(std::uint64_t seed, const DrawnCourse& drawn, const Wall& wall, const std::vector<FluidPool>& pools,
                Position position)
{
    Random patient(seed, "ileum");  // the valve's width and the ileum's are the patient's, the way the position's
    Ileum ileum;
    ileum.truth.neck_radius_mm = patient.uniform(1.5, 2.5);
    ileum.truth.radius_mm = patient.uniform(5, 10);
    const double wanted_mm = patient.uniform(100, 200);
    Random random(seed, "ileum's way", std::uint64_t(position));
    std::vector<Point3> way;
    Valve valve;
    double neck_mm = 0, chosen_mm = 0;
    for (int n = 0; n < kWays && double(way.size()) * kStep_mm < wanted_mm; ++n) {
        const Valve at = drawValve(drawn, wall, random);
        const double neck = at.wall_mm + random.uniform(2, 6);
        const double radius = std::lerp(ileum.truth.radius_mm, kNarrowest_mm, double(n) / kWays);
        std::vector<Point3> next = Grower(drawn, at, radius).grow(wanted_mm, neck, random);
        if (next.size() <= way.size())
            continue;
        chosen_mm = radius;
        way.swap(next);
        valve = at;
        neck_mm = neck;
    }
    ileum.truth.radius_mm = chosen_mm;
    ileum.truth.valve_mm = valve.mouth_mm;
    ileum.truth.station_mm = valve.station_mm;
    ileum.truth.length_mm = neck_mm + kStep_mm * (double(way.size()) - 2);
    if (ileum.truth.length_mm < kShortest_mm)
        throw Error(ErrorCode::internal, "there is no room for an ileum beside this colon", {}, "use another seed");
    const Point3 within = valve.mouth_mm - valve.outward * 3.0;
    ileum.lumen.push_back(link(within, way[1], ileum.truth.neck_radius_mm, 0));
    ileum.wall.push_back(link(way[0], way[1], ileum.truth.neck_radius_mm + kWall_mm + 1, kWall_hu));
    for (std::size_t n = 2; n < way.size(); ++n) {
        const double share = std::min(1.0, double(n - 1) / 3);
        const double radius = std::lerp(ileum.truth.neck_radius_mm, ileum.truth.radius_mm, share);
        ileum.wall.push_back(link(way[n - 1], way[n], radius + kWall_mm, kWall_hu));
        ileum.lumen.push_back(link(way[n - 1], way[n], radius, kGas_hu));
    }
    fill(ileum, way, valve, pools, -gravityOf(position), random);
    return ileum;
}

}  // namespace vicon::phantom
