#pragma once

#include <array>
#include <optional>
#include <utility>

#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

/// The faces of a cube around an eye, as the eye is turned.
enum class CubeFace { left, front, right, back, top, bottom };
inline constexpr std::array kCubeFaces{CubeFace::front, CubeFace::left,   CubeFace::right,
                                       CubeFace::top,   CubeFace::bottom, CubeFace::back};

/// The pose that looks at a face, with 90 degrees of view over its width and height. Each is turned so that its picture
/// continues that of the front, the back's that of the right.
Pose poseOf(CubeFace face, const Pose& eye);

/// The six faces of a cube around an eye laid out flat: left, front, right, back in a row, the top above the front, the
/// bottom below it (F. M. Vos et al., Three-dimensional display modes for CT colonography, Radiology 228, 2003). All
/// that lies around the eye is shown, each direction once.
class CubeLayout {
public:
    /// Faces as large as fit into a picture of this size, in its middle.
    CubeLayout(int width, int height);

    int side() const { return side_; }
    /// Of a face, its upper left corner.
    Pixel cornerOf(CubeFace face) const;
    Lens lens() const { return {90, side_, side_}; }
    /// Nothing beside the faces.
    std::optional<CubeFace> faceAt(Pixel at) const;
    /// Unit vector from the eye through a pixel; nothing beside the faces.
    std::optional<Vector3> rayThrough(const Pose& eye, Pixel at) const;
    /// Where a point is seen; it must not be where the eye is.
    Pixel toPixel(const Pose& eye, Point3 p) const;
    /// The part of a straight line that a face shows, from end to end; nothing where it shows none.
    std::optional<std::pair<Pixel, Pixel>> partOn(CubeFace face, const Pose& eye, Point3 from, Point3 to) const;

private:
    int side_ = 1;
    Pixel corner_;
};

}  // namespace vicon::viewer
