#pragma once

#include <cmath>
#include <numbers>

#include "vicon/core/geometry.h"

namespace vicon::viewer {

inline double radians(double degrees)
{
    return degrees * std::numbers::pi / 180;
}

/// A place in a picture: pixels from its upper left corner, x to the right, y down; the middle of the first pixel is
/// (0.5, 0.5).
struct Pixel {
    double x = 0, y = 0;
    friend bool operator==(Pixel, Pixel) = default;
};

/// Where an eye is and how it is turned. `forward` and `up` are orthogonal unit vectors.
struct Pose {
    Point3 eye_mm;
    Vector3 forward{0, 1, 0};
    Vector3 up{0, 0, 1};

    /// To the right in the picture. LPS is right-handed, so looking posterior with the head up this is the patient's
    /// left.
    Vector3 right() const { return cross(forward, up); }
    friend bool operator==(const Pose&, const Pose&) = default;
};

/// A perspective picture: the angle of view over its height, and its size.
struct Lens {
    double view_angle_deg = 90;
    int width = 0, height = 0;

    /// Distance of the picture's plane from the eye, in pixels.
    double focal_px() const { return height / 2.0 / std::tan(radians(view_angle_deg) / 2); }
    friend bool operator==(const Lens&, const Lens&) = default;
};

/// A point of space in a picture. What lies behind the eye has a depth of 0 or less and no meaningful pixel.
struct Projected {
    Pixel at;
    double depth_mm = 0;  ///< along the direction of view
};
Projected project(const Pose& pose, const Lens& lens, Point3 p);

/// Unit vector from the eye through a pixel.
Vector3 rayThrough(const Pose& pose, const Lens& lens, Pixel at);

/// A unit vector orthogonal to the unit vector `forward`, as near to `wanted` as that allows; any such vector where
/// `wanted` is along `forward`.
Vector3 uprightOn(Vector3 forward, Vector3 wanted);

/// A pose at `eye` that looks at `target`. The two must differ.
Pose lookAt(Point3 eye, Point3 target, Vector3 up_wanted);

/// A picture in parallel projection, a slice or an overview: pixel distances are millimetres, seen along right x down.
struct PlaneView {
    Point3 centre_mm;     ///< at the middle of the picture
    Vector3 right, down;  ///< orthogonal unit vectors in the picture's plane
    double mm_per_pixel = 1;
    int width = 0, height = 0;

    Pixel toPixel(Point3 p) const
    {
        const Vector3 d = p - centre_mm;
        return {width / 2.0 + dot(d, right) / mm_per_pixel, height / 2.0 + dot(d, down) / mm_per_pixel};
    }
    Point3 pointAt(Pixel at) const
    {
        return centre_mm + right * ((at.x - width / 2.0) * mm_per_pixel) +
               down * ((at.y - height / 2.0) * mm_per_pixel);
    }
    /// The direction of view.
    Vector3 forward() const { return cross(right, down); }
    /// How far `p` lies in front of the plane, along the direction of view.
    double depth_mm(Point3 p) const { return dot(p - centre_mm, forward()); }
};

}  // namespace vicon::viewer
