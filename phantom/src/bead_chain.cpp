#include "bead_chain.h"

#include <algorithm>
#include <cmath>

#include "curve.h"

namespace vicon::phantom {
namespace {

constexpr double kBeadSpacing = 5;

}  // namespace

std::vector<WayPoint> variedWay(Random& random)
{
    std::vector<WayPoint> way = usualWay();
    const double sag_mm = random.uniform(-10, 45), girth = random.uniform(0.95, 1.07);
    const Vector3 sigmoid{random.uniform(-20, 20), random.uniform(-12, 12), random.uniform(-5, 40)};
    for (std::size_t n = 0; n < way.size(); ++n) {
        WayPoint& stop = way[n];
        const double spread_mm = n < 2 ? 0 : 3 + 5 * stop.mobility;
        stop.position_mm += Vector3{random.normal(), random.normal(), random.normal()} * spread_mm;
        stop.radius_mm *= girth * random.uniform(0.92, 1.08);
        if (n >= 17 && n <= 23)
            stop.position_mm.z -= sag_mm * stop.mobility;
        if (n >= 4 && n <= 9)
            stop.position_mm += sigmoid * stop.mobility;
    }
    return way;
}

std::vector<Bead> beadsAlong(const std::vector<WayPoint>& way, double length_mm)
{
    std::vector<Point3> positions;
    std::vector<double> radii, mobilities;
    for (const WayPoint& stop : way) {
        positions.push_back(stop.position_mm);
        radii.push_back(stop.radius_mm);
        mobilities.push_back(stop.mobility);
    }
    const auto count = std::size_t(length_mm / kBeadSpacing);
    std::vector<Bead> beads(count);
    for (std::size_t n = 0; n < count; ++n) {
        const double at = double(n) / double(count - 1) * double(way.size() - 1);
        beads[n] = {splinePoint(positions, at), {}, splineValue(radii, at), splineValue(mobilities, at), 0};
        beads[n].anchor_mm = beads[n].position_mm;
    }
    double plain = 0, mobile = 0;
    for (std::size_t n = 0; n + 1 < count; ++n) {
        beads[n].rest_mm = distance(beads[n].position_mm, beads[n + 1].position_mm);
        plain += beads[n].rest_mm;
        mobile += beads[n].rest_mm * (0.05 + beads[n].mobility);
    }
    for (Bead& bead : beads)
        bead.rest_mm *= 1 + (length_mm - plain) / mobile * (0.05 + bead.mobility);
    return beads;
}

std::vector<double> stopFractions(const std::vector<Bead>& beads, std::size_t stops)
{
    std::vector<double> passed{0}, fractions;
    for (std::size_t n = 0; n + 1 < beads.size(); ++n)
        passed.push_back(passed.back() + beads[n].rest_mm);
    for (std::size_t stop = 0; stop < stops; ++stop)
        fractions.push_back(splineValue(passed, double(stop) / double(stops - 1) * double(beads.size() - 1)) /
                            passed.back());
    return fractions;
}

std::vector<double> stationsOnChain(const std::vector<Bead>& beads, const std::vector<double>& fractions,
                                    double length_mm)
{
    std::vector<double> passed{0}, stations;
    for (std::size_t n = 0; n + 1 < beads.size(); ++n)
        passed.push_back(passed.back() + distance(beads[n].position_mm, beads[n + 1].position_mm));
    for (const double fraction : fractions) {
        const double at = fraction * double(beads.size() - 1);
        const auto n = std::min(std::size_t(at), beads.size() - 2);
        stations.push_back(std::lerp(passed[n], passed[n + 1], at - double(n)) / passed.back() * length_mm);
    }
    return stations;
}

std::vector<Bead> evenBeads(const std::vector<Bead>& beads)
{
    double total = 0;
    for (std::size_t n = 0; n + 1 < beads.size(); ++n)
        total += beads[n].rest_mm;
    const auto count = std::size_t(total / kBeadSpacing) + 1;
    const double link = total / double(count - 1);
    std::vector<Bead> even;
    std::size_t n = 0;
    double passed = 0;
    for (std::size_t m = 0; m < count; ++m) {
        const double at = link * double(m);
        while (n + 2 < beads.size() && passed + beads[n].rest_mm < at)
            passed += beads[n++].rest_mm;
        const double t = std::clamp((at - passed) / beads[n].rest_mm, 0.0, 1.0);
        const Bead &a = beads[n], &b = beads[n + 1];
        even.push_back({interpolate(a.position_mm, b.position_mm, t), interpolate(a.anchor_mm, b.anchor_mm, t),
                        std::lerp(a.radius_mm, b.radius_mm, t), std::lerp(a.mobility, b.mobility, t), link});
    }
    return even;
}

void turnOver(std::vector<Bead>& beads, Position position, Random& random)
{
    const Vector3 down = gravityOf(position);
    std::vector<Point3> shift(beads.size() / 14 + 4);
    for (Point3& s : shift)
        s = Point3{} + Vector3{random.normal(), random.normal(), random.normal()} * 7.0;
    for (std::size_t n = 0; n < beads.size(); ++n) {
        const Vector3 wander = splinePoint(shift, double(n) / 14 + 1) - Point3{};
        beads[n].anchor_mm = beads[n].position_mm += (wander + down * 6.0) * (0.25 + 0.75 * beads[n].mobility);
        if (n == 0)
            beads[n].anchor_mm = beads[n].position_mm = beads[n].position_mm - (wander + down * 6.0) * 0.25;
    }
}

}  // namespace vicon::phantom
