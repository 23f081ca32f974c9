#include "vicon/viewer/model/visibility.h"

#include <algorithm>
#include <deque>

namespace vicon::viewer {
namespace {

constexpr double kNear_mm = 1e-3;           // a box that crosses this plane is cut there
constexpr std::size_t kMostRectangles = 8;  // of one segment, before they are united to bound the work

void widen(ViewRectangle& r, double x, double y)
{
    r.left = std::min(r.left, x);
    r.right = std::max(r.right, x);
    r.bottom = std::min(r.bottom, y);
    r.top = std::max(r.top, y);
}

ViewRectangle united(const std::vector<ViewRectangle>& rectangles)
{
    ViewRectangle all = rectangles.front();
    for (const ViewRectangle& r : rectangles) {
        widen(all, r.left, r.bottom);
        widen(all, r.right, r.top);
    }
    return all;
}

// In the eye's frame: right, up, forward.
Vector3 seenAt(const Pose& pose, Point3 p)
{
    const Vector3 d = p - pose.eye_mm;
    return {dot(d, pose.right()), dot(d, pose.up), dot(d, pose.forward)};
}

// Takes a rectangle for a segment unless it holds nothing new.
bool take(std::vector<ViewRectangle>& taken, ViewRectangle& fresh)
{
    if (std::any_of(taken.begin(), taken.end(), [&](const auto& r) { return r.contains(fresh); }))
        return false;
    if (taken.size() >= kMostRectangles) {
        taken.push_back(fresh);
        fresh = united(taken);
        taken.clear();
    }
    taken.push_back(fresh);
    return true;
}

}  // namespace

ViewRectangle intersection(const ViewRectangle& a, const ViewRectangle& b)
{
    return {std::max(a.left, b.left), std::min(a.right, b.right), std::max(a.bottom, b.bottom), std::min(a.top, b.top)};
}

ViewRectangle wholePicture(const Lens& lens)
{
    const double y = std::tan(radians(lens.view_angle_deg) / 2);
    const double x = lens.height > 0 ? y * lens.width / lens.height : y;
    return {-x, x, -y, y};
}

ViewRectangle rectangleOf(const Gate& gate, const Pose& pose)
{
    constexpr double kFar = 1e300;
    ViewRectangle r{kFar, -kFar, kFar, -kFar};
    std::array<Vector3, 8> corners;
    for (std::size_t n = 0; n < 8; ++n)
        corners[n] = seenAt(pose, gate.box_mm[n]);
    for (std::size_t n = 0; n < 8; ++n) {
        const Vector3 a = corners[n];
        if (a.z >= kNear_mm) {
            widen(r, a.x / a.z, a.y / a.z);
            continue;
        }
        // Where the lines to all other corners meet the near plane: more points than the box's edges give, none beyond
        // its hull.
        for (const Vector3 b : corners)
            if (b.z >= kNear_mm) {
                const Vector3 c = a + (b - a) * ((kNear_mm - a.z) / (b.z - a.z));
                widen(r, c.x / kNear_mm, c.y / kNear_mm);
            }
    }
    return r;
}

Visibility::Visibility(std::vector<Gate> gates) : gates_(std::move(gates))
{
    for (std::size_t n = 0; n < gates_.size(); ++n)
        for (const int segment : {gates_[n].segment_a, gates_[n].segment_b}) {
            if (gates_of_.size() <= std::size_t(segment))
                gates_of_.resize(std::size_t(segment) + 1);
            gates_of_[std::size_t(segment)].push_back(n);
        }
}

std::vector<VisibleSegment> Visibility::visibleFrom(const Pose& pose, const Lens& lens, int start) const
{
    std::vector<VisibleSegment> seen;
    std::vector<std::vector<ViewRectangle>> taken(std::max(gates_of_.size(), std::size_t(start) + 1));
    std::vector<ViewRectangle> of_gate(gates_.size());
    std::vector<bool> known(gates_.size(), false);
    struct Arrival {
        int segment;
        ViewRectangle rectangle;
    };
    std::deque<Arrival> waiting{{start, wholePicture(lens)}};
    std::vector<int> order;
    while (!waiting.empty()) {
        Arrival arrival = waiting.front();
        waiting.pop_front();
        auto& here = taken[std::size_t(arrival.segment)];
        if (here.empty())
            order.push_back(arrival.segment);
        if (!take(here, arrival.rectangle) || std::size_t(arrival.segment) >= gates_of_.size())
            continue;
        for (const std::size_t n : gates_of_[std::size_t(arrival.segment)]) {
            if (!known[n]) {
                of_gate[n] = rectangleOf(gates_[n], pose);
                known[n] = true;
            }
            const ViewRectangle beyond = intersection(arrival.rectangle, of_gate[n]);
            if (!beyond.empty())
                waiting.push_back(
                    {gates_[n].segment_a == arrival.segment ? gates_[n].segment_b : gates_[n].segment_a, beyond});
        }
    }
    seen.reserve(order.size());
    for (const int segment : order)
        seen.push_back({segment, taken[std::size_t(segment)]});
    return seen;
}

}  // namespace vicon::viewer
