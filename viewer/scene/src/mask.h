#pragma once

#include <vector>

#include "vicon/viewer/scene/canvas.h"

namespace vicon::viewer {

/// How much of each pixel a shape covers; shapes of one mask unite, so that joints are not painted twice.
class Mask {
public:
    Mask(int width, int height);

    void clear();
    void addSegment(Pixel a, Pixel b, double width_px);
    /// A rectangle with soft edges of this breadth outside of it.
    void addBox(const Area& box, double edge_px);
    /// A full disc where `inner_px` is below 0.
    void addRing(Pixel centre, double inner_px, double outer_px);
    /// Sets a pixel to at least this cover, 0 to 255; outside the picture: nothing.
    void add(int x, int y, int cover);
    void blendInto(Picture& picture, Rgb color, double strength) const;
    /// Adds to `out`, a mask of the same size, everything within `radius_px` of what is covered here.
    void growInto(Mask& out, double radius_px) const;

private:
    template <class Cover>
    void addShape(double x0, double y0, double x1, double y1, Cover cover);

    int width_, height_;
    int x0_, y0_, x1_, y1_;  // what was touched, half open
    std::vector<std::uint8_t> cover_;
};

}  // namespace vicon::viewer
