#pragma once

#include <array>
#include <vector>

#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

/// The passage between two segments that touch: a box that holds every point where a line of sight can cross from one
/// to the other, dilated by a voxel diagonal.
struct Gate {
    int segment_a = 0, segment_b = 0;
    std::array<Point3, 8> box_mm;
};

/// A rectangle of the picture's plane at distance 1 from the eye: x to the right, y up.
struct ViewRectangle {
    double left = 0, right = 0, bottom = 0, top = 0;

    bool empty() const { return left > right || bottom > top; }
    bool contains(const ViewRectangle& r) const
    {
        return r.left >= left && r.right <= right && r.bottom >= bottom && r.top <= top;
    }
};
ViewRectangle intersection(const ViewRectangle& a, const ViewRectangle& b);
ViewRectangle wholePicture(const Lens& lens);

/// What part of the picture may show what lies beyond a gate: the rectangle around the box's part before the eye; empty
/// where all of it lies behind.
ViewRectangle rectangleOf(const Gate& gate, const Pose& pose);

/// A segment that may be seen, and where in the picture.
struct VisibleSegment {
    int segment = 0;
    std::vector<ViewRectangle> through;
};

/// Which segments may be seen (thesis, Algorithms 3.2 and 3.3, on the graph of all gates): a line of sight crosses a
/// sequence of gates, so its pixel lies in the rectangle of each. Never leaves out a segment of which a triangle is
/// visible, provided that the boxes hold what Gate promises.
class Visibility {
public:
    explicit Visibility(std::vector<Gate> gates);

    /// @param start the segment of the voxel that holds the eye; it comes first in the answer
    std::vector<VisibleSegment> visibleFrom(const Pose& pose, const Lens& lens, int start) const;

    const std::vector<Gate>& gates() const { return gates_; }

private:
    std::vector<Gate> gates_;
    std::vector<std::vector<std::size_t>> gates_of_;  // by segment
};

}  // namespace vicon::viewer
