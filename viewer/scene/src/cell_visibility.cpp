#include "vicon/viewer/scene/cell_visibility.h"

namespace vicon::viewer {
namespace {

std::vector<Gate> gatesOf(const artefact::Subdivision& subdivision)
{
    std::vector<Gate> gates;
    for (const artefact::Portal& portal : subdivision.portals)
        gates.push_back({portal.segment_a, portal.segment_b, portal.box_mm});
    return gates;
}

}  // namespace

CellVisibility::CellVisibility(const PreparedScan& scan) : scan_(scan), visibility_(gatesOf(scan.subdivision()))
{
    scan_.segments();
}

int CellVisibility::segmentAt(Point3 p) const
{
    const SegmentVolume& segments = scan_.segments();
    return segments.valueOr(segments.grid.indexAt(p), 0);
}

std::vector<int> CellVisibility::segmentsSeen(const Pose& pose, const Lens& lens) const
{
    const int start = segmentAt(pose.eye_mm);
    if (start == 0)
        return {};
    std::vector<int> numbers;
    for (const SeenSegment& seen : visibility_.seenFrom(pose, lens, start))
        numbers.push_back(seen.segment);
    return numbers;
}

}  // namespace vicon::viewer
