#include "relax.h"

#include <algorithm>
#include <cmath>

namespace vicon::phantom {
namespace {

// Chosen on seeds 1 to 4, supine; seeds 1 to 20 then gave a plausible course supine and prone.
constexpr int kRounds = 500;
constexpr int kLinkSweeps = 4;
constexpr double kSharpestBend = 1.45;  // radius of the sharpest bend in radii of the lumen
constexpr int kBendSweeps = 6;
constexpr double kStiffness = 0.1;    // of the fourth difference; 1/8 is the limit of stability
constexpr double kAnchor = 0.05;      // pull of a bead that is fixed to the back wall; a mobile one feels 1/25 of it
constexpr double kPush = 0.4;         // share of an overlap that is undone in a round
constexpr double kDiaphragmGap = 14;  // mm from lumen to lung

void keepLinks(std::vector<Bead>& beads, double grown)
{
    for (int sweep = 0; sweep < kLinkSweeps; ++sweep) {
        for (std::size_t n = 0; n + 1 < beads.size(); ++n) {
            Bead &a = beads[n], &b = beads[n + 1];
            const Vector3 link = b.position_mm - a.position_mm;
            const Vector3 shift = normalized(link) * (0.4 * (length(link) - grown * a.rest_mm));
            a.position_mm += shift;
            b.position_mm += -shift;
        }
    }
}

void stiffen(std::vector<Bead>& beads)
{
    std::vector<Vector3> bend(beads.size());
    for (std::size_t n = 1; n + 1 < beads.size(); ++n)
        bend[n] = (beads[n - 1].position_mm - beads[n].position_mm) + (beads[n + 1].position_mm - beads[n].position_mm);
    for (std::size_t n = 1; n + 1 < beads.size(); ++n)
        beads[n].position_mm += -kStiffness * ((bend[n - 1] - bend[n]) + (bend[n + 1] - bend[n]));
}

/// Beads a few links apart keep the distance that they have on an arc of the sharpest bend.
void limitBends(std::vector<Bead>& beads, double grown)
{
    for (const std::size_t links : {3, 6, 9, 12}) {
        for (std::size_t n = 0; n + links < beads.size(); ++n) {
            Bead &a = beads[n], &b = beads[n + links];
            const double bend_mm = kSharpestBend * std::max(a.radius_mm, b.radius_mm);
            const double arc_mm = grown * a.rest_mm * double(links);
            const double chord_mm = 2 * bend_mm * std::sin(std::min(arc_mm / (2 * bend_mm), 1.5707963));
            const Vector3 apart = b.position_mm - a.position_mm;
            if (length(apart) >= chord_mm)
                continue;
            const Vector3 push = normalized(apart) * (kPush / 2 * (chord_mm - length(apart)));
            a.position_mm += -push;
            b.position_mm += push;
        }
    }
}

void keepLoopsApart(std::vector<Bead>& beads, double separation_mm, const std::vector<BeadPair>& pulled)
{
    std::vector<double> along(beads.size(), 0);
    for (std::size_t n = 1; n < beads.size(); ++n)
        along[n] = along[n - 1] + beads[n - 1].rest_mm;
    for (std::size_t a = 0; a < beads.size(); ++a) {
        for (std::size_t b = a + 1; b < beads.size(); ++b) {
            const double radii = beads[a].radius_mm + beads[b].radius_mm;
            if (along[b] - along[a] < loopDistance_mm(beads[a].radius_mm, beads[b].radius_mm))
                continue;
            const Vector3 apart = beads[b].position_mm - beads[a].position_mm;
            const double need = radii + separation_mm;
            if (dot(apart, apart) >= need * need)
                continue;
            const bool is_pulled = std::any_of(pulled.begin(), pulled.end(), [&](const BeadPair& pair) {
                return std::abs(double(pair.a) - double(a)) < 8 && std::abs(double(pair.b) - double(b)) < 8;
            });
            if (is_pulled)
                continue;
            const Vector3 push = normalized(apart) * (kPush / 2 * (need - length(apart)));
            beads[a].position_mm += -push;
            beads[b].position_mm += push;
        }
    }
    for (const BeadPair& pair : pulled) {
        const Vector3 apart = beads[pair.b].position_mm - beads[pair.a].position_mm;
        const Vector3 shift = normalized(apart) * (kPush / 2 * (length(apart) - pair.distance_mm));
        for (std::size_t n = 0; n <= 6; ++n) {
            const Vector3 share = shift * (1 - std::abs(double(n) - 3) / 4);
            beads[pair.a - 3 + n].position_mm += share;
            beads[pair.b - 3 + n].position_mm += -share;
        }
    }
}

void keepOutOf(const Ellipsoid& organ, Bead& bead)
{
    const Vector3 d = bead.position_mm - organ.centre_mm;
    const double margin = bead.radius_mm + 3;
    const Vector3 r{organ.radii_mm.x + margin, organ.radii_mm.y + margin, organ.radii_mm.z + margin};
    const double f = length(Vector3{d.x / r.x, d.y / r.y, d.z / r.z});
    if (f >= 1 || f < 1e-6)
        return;
    const Vector3 outward = normalized(Vector3{d.x / (r.x * r.x), d.y / (r.y * r.y), d.z / (r.z * r.z)});
    bead.position_mm += outward * (kPush * (1 - f) * std::min({r.x, r.y, r.z}));
}

void keepWithin(const Trunk& trunk, Bead& bead)
{
    Point3& p = bead.position_mm;
    Oval room = trunk.cavity(p.z);
    room.half_x_mm -= bead.radius_mm;
    room.half_y_mm -= bead.radius_mm;
    const double f = room.value(p.x, p.y);
    if (f > 1) {
        const double scale = 1 - kPush * (1 - std::pow(f, -1 / room.exponent));
        p.x *= scale;
        p.y = room.centre_y_mm + (p.y - room.centre_y_mm) * scale;
    }
    const double above = p.z + bead.radius_mm + kDiaphragmGap - trunk.diaphragm(p.x, p.y);
    if (above > 0)
        p.z -= kPush * above;
}

}  // namespace

void relax(std::vector<Bead>& beads, const Trunk& trunk, double separation_mm, const std::vector<BeadPair>& pulled)
{
    const auto organs = obstacles();
    double length_mm = 0, rest_mm = 0;
    for (std::size_t n = 0; n + 1 < beads.size(); ++n) {
        length_mm += distance(beads[n].position_mm, beads[n + 1].position_mm);
        rest_mm += beads[n].rest_mm;
    }
    for (int round = 0; round < kRounds; ++round) {
        // It grows slowly: a chain that is pressed together at once would crumple.
        const double grown = std::lerp(length_mm / rest_mm, 1.0, std::min(1.0, round / (0.7 * kRounds)));
        for (Bead& bead : beads) {
            const double hold = kAnchor * (1 - 0.96 * bead.mobility);
            bead.position_mm = interpolate(bead.position_mm, bead.anchor_mm, hold);
        }
        keepLoopsApart(beads, separation_mm, pulled);
        for (Bead& bead : beads) {
            for (const Ellipsoid& organ : organs)
                keepOutOf(organ, bead);
            keepWithin(trunk, bead);
        }
        limitBends(beads, grown);
        keepLinks(beads, grown);
        for (int sweep = 0; sweep < kBendSweeps; ++sweep)
            stiffen(beads);
        beads.front().position_mm = beads.front().anchor_mm;
    }
}

}  // namespace vicon::phantom
