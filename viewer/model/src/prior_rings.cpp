// The same place, or that of an earlier finding, as it is seen from inside.
#include <algorithm>
#include <array>
#include <cmath>

#include "vicon/viewer/model/peeling.h"
#include "vicon/viewer/model/prior_place.h"

namespace vicon::viewer {
namespace {

constexpr const char* kRingWords = ", to here";  // it lies between the rings, not in one
constexpr int kRingRays = 72;                    // rays of a ring, one for each 5 degrees
constexpr double kFarthestRing_mm = 150;         // as a marker's: further off it is too small to mean anything
constexpr double kRingTurn_rad = 6.283185307179586;
constexpr double kWidestRing_mm = 60;     // of a distended caecum half as much
constexpr double kBeforeWall_mm = 0.5;    // of the wall: there the ring is drawn, so that the wall does not hide it
constexpr double kLeastRingDepth_mm = 1;  // nearer to the eye's plane what is seen runs out of the picture

/// The wall around a station; nothing in the directions in which there is none.
std::array<std::optional<Point3>, kRingRays> wallAround(const PathFrame& frame, const Lumen& lumen)
{
    std::array<std::optional<Point3>, kRingRays> ring;
    if (!lumen.inside(frame.position_mm))
        return ring;
    const Vector3 right = cross(frame.forward, frame.up);
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const double angle = kRingTurn_rad * double(n) / kRingRays;
        const Vector3 outwards = frame.up * std::cos(angle) + right * std::sin(angle);
        if (const auto wall = distanceToWall_mm(lumen, frame.position_mm, outwards, kWidestRing_mm))
            ring[n] = frame.position_mm + outwards * std::max(0.0, *wall - kBeforeWall_mm);
    }
    return ring;
}

}  // namespace

std::vector<std::vector<Point3>> priorRings(const PriorPlace& place, const PathFrames& path, const Lumen& lumen,
                                            Point3 eye_mm)
{
    std::vector<std::vector<Point3>> lines;
    for (const double station : {place.least_mm, place.most_mm}) {
        const PathFrame frame = path.at(station);
        if (distance(eye_mm, frame.position_mm) > kFarthestRing_mm)
            continue;
        const auto ring = wallAround(frame, lumen);
        std::vector<Point3> line;
        const auto end = [&] {
            if (line.size() > 1)
                lines.push_back(line);
            line.clear();
        };
        for (std::size_t n = 0; n <= ring.size(); ++n) {  // the first once more
            const auto& p = ring[n % ring.size()];
            if (p && lumen.sees(eye_mm, *p, 2 * lumen.voxel_mm()))
                line.push_back(*p);
            else
                end();
        }
        end();
    }
    return lines;
}

void addPriorRings(Overlay& overlay, const PriorPlace& place, const PathFrames& path, const Lumen& lumen,
                   const Pose& pose, const Lens& lens, double text_px)
{
    const auto inside = [&](Pixel at) { return at.x >= 0 && at.y >= 0 && at.x < lens.width && at.y < lens.height; };
    std::optional<Pixel> highest;
    for (const std::vector<Point3>& ring : priorRings(place, path, lumen, pose.eye_mm)) {
        OverlayLine line{{}, place.color, 2, 0};
        const auto end = [&] {
            if (std::any_of(line.points.begin(), line.points.end(), inside))
                overlay.lines.push_back(line);
            line.points.clear();
        };
        for (const Point3 p : ring) {
            const Projected seen = project(pose, lens, p);
            if (seen.depth_mm < kLeastRingDepth_mm) {
                end();
                continue;
            }
            line.points.push_back(seen.at);
            if (inside(seen.at) && (!highest || seen.at.y < highest->y))
                highest = seen.at;
        }
        end();
    }
    PriorPlace end = place;
    end.label += kRingWords;
    if (highest)
        addPriorName(overlay, *highest, end, text_px);
}

}  // namespace vicon::viewer
