// Which part of its plane a slice shows.
#include <algorithm>
#include <cmath>

#include "slices/slice_view.h"
#include "vicon/viewer/model/slice_image.h"
#include "vicon/viewer/model/tracked_lumen.h"

namespace vicon::viewer {

PlaneView SliceView::viewWith(Vector3 pan_mm) const
{
    const QSize size = pictureSize();
    const Grid& grid = scan_->files.volume().grid;
    PlaneView view = sliceThrough(grid, axes(), request_.point_mm, size.width(), size.height());
    if (zoom_ > 1) {
        view.mm_per_pixel /= zoom_;
        const Vector3 to_point = request_.point_mm - view.centre_mm;  // across the plane it is none
        view.centre_mm += to_point;
    }
    view.centre_mm += pan_mm;
    if (request_.voxels_a_pixel > 0)
        view = pixelForPixel(grid, view, request_.point_mm + pan_mm, request_.voxels_a_pixel);
    return view;
}

/// Back to the slice of the point; in its plane, which across the lumen is another one at each place, the picture
/// moves as little as it may.
Vector3 SliceView::panFrom(const PlaneView& before, Point3 point_before, Move how) const
{
    const PlaneView centred = viewWith({});
    const auto isInside = [](const PlaneView& view, Point3 p, double margin) {
        const Pixel at = view.toPixel(p);
        const double x = margin * view.width, y = margin * view.height;
        return at.x >= x && at.x <= view.width - x && at.y >= y && at.y <= view.height - y;
    };
    // As far across and down in the picture as before.
    const Vector3 same = centred.right * dot(pan_mm_, before.right) + centred.down * dot(pan_mm_, before.down);
    if (zoom_ <= 1 && request_.voxels_a_pixel == 0)
        return same;
    constexpr double kMargin = 0.1;  // of the picture: nearer to its edge, what lies around the point is not seen
    if (how == Move::with_the_point)
        return isInside(before, point_before, 0) ? same : Vector3{};
    const Vector3 off = before.centre_mm - request_.point_mm;
    const Vector3 stays = off - centred.forward() * dot(off, centred.forward());
    return isInside(viewWith(stays), request_.point_mm, kMargin) ? stays : Vector3{};
}

/// The cross stays where it is in the picture.
void SliceView::zoom(int notches)
{
    constexpr double kNotch = 1.2, kMost = 20;
    request_.voxels_a_pixel = 0;
    const double before = zoom_;
    zoom_ = std::clamp(zoom_ * std::pow(kNotch, notches), 1.0, kMost);
    const PlaneView& view = request_.view;
    const Vector3 off = view.centre_mm - request_.point_mm;
    const Vector3 across = view.forward() * dot(off, view.forward());
    pan_mm_ = zoom_ > 1 ? across + (off - across) * (before / zoom_) : across;
    draw();
}

SliceAxes SliceView::axes() const
{
    return request_.plane == SlicePlane::across ? axesAcross(scan_->files.frames(), request_.point_mm, request_.pose)
                                                : axesOf(request_.plane);
}

}  // namespace vicon::viewer
