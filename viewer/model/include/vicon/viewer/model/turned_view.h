#pragma once

#include "vicon/core/cell_surface.h"
#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/model/orientation.h"

namespace vicon::viewer {

/// How a whole organ is looked at from outside, in parallel projection: turned, moved and enlarged by hand.
class TurnedView {
public:
    static constexpr double kMostZoom = 20;

    /// From the front, all of it.
    TurnedView() { reset(); }
    void reset();
    bool fromFront() const { return from_front_; }

    /// Turns the organ as a ball under the hand: what is nearest follows the mouse.
    /// @param by in pixels, to the right and down
    /// @param ball_px radius of the ball
    void turn(Pixel by, double ball_px);
    /// @param by_mm in the picture, to the right and down
    void move(Pixel by_mm);
    /// By notches of a wheel; what is at `at_mm` from the picture's middle stays there.
    void zoom(int notches, Pixel at_mm);

    /// The picture of a surface: it fits whole at a zoom of 1, however it is turned.
    PlaneView over(const CellSurface& surface, int width, int height) const;

    friend bool operator==(const TurnedView&, const TurnedView&) = default;

private:
    Vector3 right_, down_;
    Pixel moved_mm_;
    double zoom_ = 1;
    bool from_front_ = true;
};

}  // namespace vicon::viewer
