#include "vicon/viewer/scene/cell_visibility.h"

#include <algorithm>
#include <cmath>

#include "cell_actors.h"

namespace vicon::viewer {
namespace {

std::vector<Gate> gatesOf(const Subdivision& subdivision)
{
    std::vector<Gate> gates;
    for (const Portal& portal : subdivision.portals)
        gates.push_back({portal.segment_a, portal.segment_b, portal.box_mm});
    return gates;
}

// From the eye to the corners of the near plane.
double nearCorner_mm(const Lens& lens)
{
    const double up = std::tan(radians(lens.view_angle_deg) / 2);
    const double aside = lens.height > 0 ? up * lens.width / lens.height : up;
    return kNearPlane_mm * std::hypot(1.0, up, aside);
}

}  // namespace

CellVisibility::CellVisibility(const PreparedScan& scan, Means means, const Progress* wanted)
    : scan_(scan), visibility_(gatesOf(scan.subdivision()))
{
    scan_.segments();
    if (means == Means::gates_and_sight_lines) {
        const CellSurface& surface = scan.cells();
        const std::vector<Patch> patches = patchesOf(surface.segment);
        sight_lines_.emplace(scan.inside(), DrawnSurface{surface.points_mm, surface.triangles, patches}, wanted);
        for (std::size_t n = 0; n < patches.size(); ++n) {
            if (cells_.empty() || cells_.back().segment != patches[n].cell)
                cells_.push_back({patches[n].cell, n, n});
            cells_.back().end = n + 1;
        }
    }
}

int CellVisibility::segmentAt(Point3 p) const
{
    const SegmentView& segments = scan_.segments();
    return segments.valueOr(segments.grid.indexAt(p), 0);
}

VisibleParts CellVisibility::visibleFrom(const Pose& pose, const Lens& lens) const
{
    const int start = segmentAt(pose.eye_mm);
    if (start == 0 || (sight_lines_ && !sight_lines_->holdsAt(pose.eye_mm, nearCorner_mm(lens))))
        return {};
    VisibleParts seen{.everything = false, .segments = {}, .patches = {}};
    std::vector<bool> through_gates;
    for (const VisibleSegment& segment : visibility_.visibleFrom(pose, lens, start)) {
        through_gates.resize(std::max(through_gates.size(), std::size_t(segment.segment) + 1));
        through_gates[std::size_t(segment.segment)] = true;
    }
    std::vector<bool> shown = through_gates;
    if (sight_lines_) {
        seen.patches = sight_lines_->visibleFrom(pose, lens);
        shown.assign(through_gates.size(), false);
        for (const CellPatches& cell : cells_) {
            const auto first = seen.patches.begin() + std::ptrdiff_t(cell.first);
            const auto end = seen.patches.begin() + std::ptrdiff_t(cell.end);
            const auto number = std::size_t(cell.segment);
            if (number >= through_gates.size() || !through_gates[number])
                std::fill(first, end, std::uint8_t(0));
            else
                shown[number] = std::find(first, end, 1) != end;
        }
    }
    for (std::size_t n = 0; n < shown.size(); ++n)
        if (shown[n])
            seen.segments.push_back(int(n));
    return seen;
}

std::vector<int> CellVisibility::segmentsSeen(const Pose& pose, const Lens& lens) const
{
    return visibleFrom(pose, lens).segments;
}

}  // namespace vicon::viewer
