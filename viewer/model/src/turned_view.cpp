#include "vicon/viewer/model/turned_view.h"

#include <algorithm>
#include <cmath>

#include "rotation.h"

namespace vicon::viewer {

void TurnedView::reset()
{
    const SliceAxes axes = axesOf(SlicePlane::coronal);
    right_ = axes.right;
    down_ = axes.down;
    moved_mm_ = {0, 0};
    zoom_ = 1;
    from_front_ = true;
}

void TurnedView::turn(Pixel by, double ball_px)
{
    // The axes turn the other way about than the organ.
    const Vector3 about = down_ * (by.x / ball_px) - right_ * (by.y / ball_px);
    const Vector3 right = normalized(rotated(right_, about));
    down_ = uprightOn(right, rotated(down_, about));
    right_ = right;
    from_front_ = false;
}

void TurnedView::move(Pixel by_mm)
{
    moved_mm_ = {moved_mm_.x + by_mm.x, moved_mm_.y + by_mm.y};
    from_front_ = false;
}

void TurnedView::zoom(int notches, Pixel at_mm)
{
    constexpr double kNotch = 1.2;
    const double before = zoom_;
    zoom_ = std::clamp(zoom_ * std::pow(kNotch, notches), 1.0, kMostZoom);
    const double grown = zoom_ / before;
    move({(1 - grown) / grown * at_mm.x, (1 - grown) / grown * at_mm.y});
}

PlaneView TurnedView::over(const CellSurface& surface, int width, int height) const
{
    Point3 least{1e30, 1e30, 1e30}, most{-1e30, -1e30, -1e30};
    for (std::size_t n = 0; n < surface.pointCount(); ++n) {
        const Point3 p = surface.point(n);
        least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
        most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
    }
    const Point3 centre = interpolate(least, most, 0.5);
    double radius_mm = 1;
    for (std::size_t n = 0; n < surface.pointCount(); ++n)
        radius_mm = std::max(radius_mm, distance(surface.point(n), centre));
    const double mm_per_pixel = 2 * radius_mm / std::min(width, height) / zoom_;
    return {centre - right_ * moved_mm_.x - down_ * moved_mm_.y, right_, down_, mm_per_pixel, width, height};
}

}  // namespace vicon::viewer
