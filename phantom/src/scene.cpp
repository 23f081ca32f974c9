#include "scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "densities.h"

namespace vicon::phantom {
namespace {

constexpr double kSoft_hu = 45, kCortex_hu = 550, kMarrow_hu = 190, kMetal_hu = 9000;

Solid ellipsoid(Point3 centre, Vector3 radii, double hu)
{
    return {Solid::Kind::ellipsoid, centre, centre, radii, hu, false, 0};
}
Solid capsule(Point3 a, Point3 b, double radius, double hu)
{
    return {Solid::Kind::capsule, a, b, {radius, radius, radius}, hu, false, 0};
}

/// Cortex around marrow.
void addBone(std::vector<Solid>& out, Solid bone, double cortex_mm)
{
    bone.density_hu = kCortex_hu;
    out.push_back(bone);
    bone.radii_mm = bone.radii_mm - Vector3{cortex_mm, cortex_mm, cortex_mm};
    bone.density_hu = kMarrow_hu;
    out.push_back(bone);
}

/// Densities without contrast medium and in the portal venous phase.
struct Densities {
    explicit Densities(bool contrast) : medium(contrast) {}
    bool medium;
    double wall_hu = medium ? 120 : kWall_hu;
    double kidney_hu = medium ? 190 : 36, liver_hu = medium ? 115 : 60, spleen_hu = medium ? 125 : 50;
    double aorta_hu = medium ? 165 : 42, cava_hu = medium ? 150 : 40, vessel_hu = medium ? 160 : 40;
};

void addOrgans(std::vector<Solid>& out, Vector3 up, const Densities& densities)
{
    for (const double side : {-1.0, 1.0}) {
        out.push_back(capsule({side * 40, 70, 280}, {side * 58, 38, 112}, 19, 55));  // psoas
        out.push_back(capsule({side * 32, 98, 100}, {side * 32, 98, 430}, 14, 50));  // back muscles
        out.push_back(ellipsoid({side * 88, 70, 60}, {62, 36, 75}, 52));             // gluteal muscles
        out.push_back(ellipsoid({side * 63, 54, side > 0 ? 285.0 : 270.0}, {27, 23, 48}, densities.kidney_hu));
        out.push_back(ellipsoid({side * 58, 50, side > 0 ? 285.0 : 270.0}, {12, 10, 24}, -80));
    }
    out.push_back(ellipsoid({-72, -14, 352}, {86, 80, 60}, densities.liver_hu));
    out.push_back(ellipsoid({106, 46, 358}, {28, 34, 32}, densities.spleen_hu));
    out.push_back(ellipsoid({15, 22, 315}, {55, 12, 14}, 42));   // pancreas
    out.push_back(ellipsoid({20, -20, 432}, {58, 48, 34}, 42));  // heart
    out.push_back(ellipsoid({0, -30, 60}, {36, 27, 27}, 8));     // bladder
    out.push_back(ellipsoid({0, 4, 40}, {21, 17, 15}, 45));      // prostate
    out.push_back(capsule({0, 44, 0}, {0, 44, 40}, 13, 50));     // anal canal
    out.push_back(capsule({9, 46, 140}, {7, 50, 430}, 10, densities.aorta_hu));
    out.push_back(capsule({-18, 46, 140}, {-18, 44, 430}, 10, densities.cava_hu));
    const Point3 stomach{46, -22, 350};
    out.push_back(ellipsoid(stomach, {40, 36, 25}, kSoft_hu));
    Solid content = ellipsoid(stomach, {36.5, 32.5, 21.5}, 25);
    content.has_level = true;
    content.level_mm = dot(stomach - Point3{}, up) - 4;
    out.push_back(content);
}

void addBones(std::vector<Solid>& out)
{
    for (double z = 128; z < 450; z += 35) {
        out.push_back(ellipsoid({0, 78, z + 17.5}, {23, 17, 8}, 85));  // disc
        addBone(out, ellipsoid({0, 78, z}, {25, 19, 17}, 0), 2.2);
        out.push_back(capsule({0, 97, z - 17}, {0, 97, z + 17}, 7.5, 30));
        for (const double side : {-1.0, 1.0}) {
            addBone(out, capsule({side * 14, 86, z + 4}, {side * 17, 99, z + 2}, 4.5, 0), 2);
            addBone(out, capsule({side * 17, 97, z + 2}, {side * 38, 100, z}, 4, 0), 2);
        }
        addBone(out, capsule({0, 106, z - 4}, {0, 109, z - 12}, 4, 0), 2);
    }
    addBone(out, ellipsoid({0, 96, 100}, {40, 9, 22}, 0), 2);  // sacrum, coccyx
    addBone(out, ellipsoid({0, 98, 70}, {26, 7.5, 20}, 0), 2);
    for (const double side : {-1.0, 1.0}) {
        addBone(out, ellipsoid({side * 138, 34, 135}, {8, 46, 46}, 0), 2);
        addBone(out, ellipsoid({side * 96, 4, 46}, {25, 25, 25}, 0), 2.5);
        addBone(out, capsule({side * 112, -2, 30}, {side * 140, 4, 0}, 15, 0), 3);
        addBone(out, capsule({side * 62, 44, 20}, {side * 70, 24, 60}, 12, 0), 2);
        addBone(out, capsule({side * 10, -72, 42}, {side * 62, -46, 58}, 8, 0), 2);
    }
}

/// Head and stem of cobalt and chromium, on the patient's right.
void addMetalHip(std::vector<Solid>& out)
{
    out.push_back(ellipsoid({-96, 4, 46}, {16, 16, 16}, kMetal_hu));
    out.push_back(capsule({-96, 4, 46}, {-124, 0, 12}, 8, kMetal_hu));
}

void addRibs(std::vector<Solid>& out, const Trunk& trunk)
{
    using std::numbers::pi;
    for (int rib = 0; rib < 9; ++rib) {
        const double back_z = 272 + 27 * rib, front = rib < 2 ? 0.1 : -1.0;  // the lowest end at the side
        Point3 last;
        bool first = true;
        for (double angle = 75; angle >= -70; angle -= 8) {
            const double sine = std::sin(angle * pi / 180), cosine = std::cos(angle * pi / 180);
            if (sine < front)
                break;
            const double z = back_z - 42 * (1 - sine);
            const Oval room = trunk.cavity(z);
            const Point3 p{(room.half_x_mm + 6) * std::pow(cosine, 0.8),
                           room.centre_y_mm + (room.half_y_mm + 6) * std::copysign(std::pow(std::abs(sine), 0.8), sine),
                           z};
            if (!first)
                for (const double side : {-1.0, 1.0})
                    addBone(out, capsule({side * last.x, last.y, last.z}, {side * p.x, p.y, p.z}, 4.5, 0), 1.8);
            last = p;
            first = false;
        }
    }
}

/// Distance from a point to the outside of the colon's wall, roughly.
double clearOfColon(const Course& course, Point3 p)
{
    double least = 1e9;
    for (std::size_t n = 0; n < course.samples.size(); n += 4)
        least = std::min(least, distance(p, course.samples[n].position_mm) - course.samples[n].radius_mm);
    return least - 2;
}

Point3 anywhereInBelly(Random& random)
{
    return {random.uniform(-95, 95), random.uniform(-80, 30), random.uniform(120, 300)};
}

/// Loops of small bowel between those of the colon; some hold gas, all of it narrower than 8 mm in radius.
void addSmallBowel(std::vector<Solid>& out, const Course& course, const Trunk& trunk, Random& random, Vector3 up,
                   double wall_hu)
{
    int with_gas = 0;
    for (int tries = 0; tries < 600; ++tries) {
        Point3 at = anywhereInBelly(random);
        Vector3 along = anyDirection(random);
        const double radius = random.uniform(8, 11);
        const bool gas = with_gas < 9;
        const int links = gas ? 2 : 2 + random.below(4);
        std::vector<Point3> way{at};
        for (int n = 0; n < links; ++n) {
            along = normalized(along + 0.5 * anyDirection(random));
            way.push_back(way.back() + along * 11);
        }
        if (std::any_of(way.begin(), way.end(), [&](Point3 p) {
                return !inBelly(trunk, p, radius) || clearOfColon(course, p) < radius + (gas ? 5 : 1);
            }))
            continue;
        with_gas += gas;
        for (std::size_t n = 1; n < way.size(); ++n)
            out.push_back(capsule(way[n - 1], way[n], radius, wall_hu));
        const double content_hu = random.uniform(5, 35);
        for (std::size_t n = 1; n < way.size(); ++n) {
            Solid content = capsule(way[n - 1], way[n], gas ? std::min(radius - 2.5, 6.5) : radius - 2.2, content_hu);
            content.has_level = gas;
            content.level_mm = dot(at - Point3{}, up) - 3;
            out.push_back(content);
        }
    }
}

void addVessels(std::vector<Solid>& out, const Trunk& trunk, Random& random, double density_hu)
{
    for (int n = 0; n < 160; ++n) {
        const Point3 at = anywhereInBelly(random);
        const Point3 end = at + anyDirection(random) * random.uniform(10, 35);
        const double radius = random.uniform(0.8, 2.2);
        if (inBelly(trunk, at, radius) && inBelly(trunk, end, radius))
            out.push_back(capsule(at, end, radius, density_hu));
    }
    for (int n = 0; n < 400; ++n) {
        const Point3 at{random.uniform(-140, 140), random.uniform(-90, 90), random.uniform(350, 440)};
        const Oval room = trunk.cavity(at.z);
        if (at.z > trunk.diaphragm(at.x, at.y) + 6 && room.value(at.x * 1.1, at.y * 1.1) < 1)
            out.push_back(capsule(at, at + anyDirection(random) * random.uniform(4, 12), random.uniform(0.5, 1.6), 20));
    }
}

/// A tube of silicone through the anus, its tip 45 mm inside the rectum. As in patients it lies beside the axis, so the
/// middle of the lumen is free.
std::vector<Solid> rectalTube(const Course& course)
{
    constexpr double kInside_mm = 45, kOffAxis_mm = 6.5, kOuter_mm = 4.2, kHollow_mm = 2.2;
    std::vector<Point3> way;
    const auto& s = course.samples;
    way.push_back(s[0].position_mm + s[0].normal * kOffAxis_mm - s[0].tangent * 75.0);
    for (double station = 0; station <= kInside_mm; station += 5) {
        const CourseSample& at = s[course.sampleAt(station)];
        way.push_back(at.position_mm + at.normal * kOffAxis_mm);
    }
    std::vector<Solid> tube;
    for (std::size_t n = 1; n < way.size(); ++n)
        tube.push_back(capsule(way[n - 1], way[n], kOuter_mm, 140));
    for (std::size_t n = 1; n + 1 < way.size(); ++n)
        tube.push_back(capsule(way[n - 1], way[n], kHollow_mm, kGas_hu));
    return tube;
}

}  // namespace

Vector3 anyDirection(Random& random)
{
    return normalized({random.normal(), random.normal(), random.normal()});
}

bool inBelly(const Trunk& trunk, Point3 p, double radius)
{
    Oval room = trunk.cavity(p.z);
    room.half_x_mm -= radius + 2;
    room.half_y_mm -= radius + 2;
    return room.value(p.x, p.y) < 1;
}

double distanceTo(const Solid& solid, Point3 p)
{
    if (solid.kind == Solid::Kind::capsule) {
        const Vector3 axis = solid.b - solid.a, d = p - solid.a;
        const double t = std::clamp(dot(d, axis) / std::max(dot(axis, axis), 1e-9), 0.0, 1.0);
        return length(d - axis * t) - solid.radii_mm.x;
    }
    const Vector3 d = p - solid.a, r = solid.radii_mm;
    const Vector3 unit{d.x / r.x, d.y / r.y, d.z / r.z}, slope{unit.x / r.x, unit.y / r.y, unit.z / r.z};
    const double f = length(unit);
    return f < 1e-6 ? -std::min({r.x, r.y, r.z}) : (f - 1) * f / length(slope);
}

Scene drawScene(std::uint64_t seed, const DrawnCourse& drawn, Position position, const SceneOptions& options)
{
    Scene scene;
    scene.trunk = drawn.trunk;
    scene.down = gravityOf(position);
    const Densities densities(options.contrast);
    scene.wall_hu = densities.wall_hu;
    const Vector3 up = -scene.down;
    for (double z = 0; z <= kHeightMm; z += 10) {
        const Oval skin = scene.trunk.skin(z);
        scene.table_mm =
            std::max(scene.table_mm, std::abs(scene.down.x) * skin.half_x_mm + std::abs(scene.down.y) * skin.half_y_mm +
                                         scene.down.y * skin.centre_y_mm);
    }
    scene.table_mm += 3;
    Random random(seed, "gut");
    addOrgans(scene.organs, up, densities);
    addSmallBowel(scene.organs, drawn.course, scene.trunk, random, up, densities.wall_hu);
    addVessels(scene.bones, scene.trunk, random, densities.vessel_hu);
    addBones(scene.bones);
    addRibs(scene.bones, scene.trunk);
    if (options.metal_hip)
        addMetalHip(scene.bones);
    if (options.catheter)
        scene.tube = rectalTube(drawn.course);
    return scene;
}

}  // namespace vicon::phantom
