#include "slices/slice_view.h"

#include <algorithm>
#include <cmath>

#include "vicon/viewer/model/slice_image.h"

namespace vicon::viewer {

SliceView::SliceView(SlicePlane plane, const QString& name, QWidget* parent) : PictureView(name, parent), plane_(plane)
{
    request_.plane = plane;
    setToolTip(
        tr("Click: look there. Wheel: scroll. Control and wheel: zoom. Right button: pan. Double click: "
           "enlarge. Shift and click: marker."));
    connect(this, &PictureView::resized, this, &SliceView::draw);
    connect(this, &PictureView::turned, this, &SliceView::scroll);
    connect(worker_.worker(), &Worker::failed, this, &SliceView::failed);
    connect(this, &PictureView::dragged, this, [this](QPointF by, Qt::MouseButton button) {
        if (button == Qt::LeftButton)
            return;
        const PlaneView& view = request_.view;
        pan_mm_ -= (view.right * by.x() + view.down * by.y()) * view.mm_per_pixel;
        draw();
    });
    connect(this, &PictureView::endDragged, this,
            [this](int end, Pixel at, bool released) { emit lineDragged(end, shown_.pointAt(at), released); });
    connect(this, &PictureView::clicked, this,
            [this](Pixel at, Qt::KeyboardModifiers modifiers) { emit pointClicked(shown_.pointAt(at), modifiers); });
}

void SliceView::look(std::shared_ptr<OpenScan> scan, Point3 point, const Pose& pose, std::vector<Marker> markers)
{
    if (!(point == request_.point_mm))  // back to the slice of the point; what was panned across it stays
        pan_mm_ -= request_.view.forward() * dot(pan_mm_, request_.view.forward());
    scan_ = std::move(scan);
    request_.point_mm = point;
    request_.pose = pose;
    request_.markers = std::move(markers);
    request_.caption = scan_->caption;
    draw();
}

void SliceView::setWindow(const WindowLevel& window)
{
    request_.window = window;
    draw();
}

void SliceView::setCleansed(bool cleansed)
{
    request_.cleansed = cleansed;
    draw();
}

QPoint SliceView::home() const
{
    const QPoint at = scan_ ? toWidget(shown_.toPixel(request_.point_mm)).toPoint() : rect().center();
    return rect().contains(at) ? at : rect().center();
}

void SliceView::resetView()
{
    pan_mm_ = {};
    zoom_ = 1;
    draw();
}

void SliceView::scroll(int steps, Qt::KeyboardModifiers modifiers)
{
    if (!scan_)
        return;
    if (modifiers & Qt::ControlModifier) {
        constexpr double kNotch = 1.2, kMost = 20;
        zoom_ = std::clamp(zoom_ * std::pow(kNotch, steps), 1.0, kMost);
    } else {
        const auto& spacing = scan_->files.volume().grid.spacing_mm;
        pan_mm_ += request_.view.forward() * (steps * *std::min_element(spacing.begin(), spacing.end()));
    }
    draw();
}

void SliceView::draw()
{
    if (!scan_)
        return;
    const QSize size = pictureSize();
    PlaneView view = sliceThrough(scan_->files.volume().grid, plane_, request_.point_mm, size.width(), size.height());
    if (zoom_ > 1) {
        view.mm_per_pixel /= zoom_;
        const Vector3 to_point = request_.point_mm - view.centre_mm;  // across the plane it is none
        view.centre_mm += to_point;
    }
    view.centre_mm += pan_mm_;
    request_.view = view;
    request_.pixel_ratio = devicePixelRatioF();
    worker_.post("slice", [this, scan = scan_, request = request_](SlicePictures& pictures) -> Worker::Work {
        const std::shared_ptr<const PreparedScan> files(scan, &scan->files);
        auto picture = std::make_shared<Picture>(pictures.draw(files, request));
        worker_.post("next slices", [](SlicePictures& ahead) -> Worker::Work {
            ahead.readAhead();
            return {};
        });
        return [this, picture, scan, view = request.view] {
            if (scan == scan_)
                show(*picture, view);
        };
    });
}

void SliceView::show(const Picture& picture, const PlaneView& view)
{
    shown_ = view;
    showPicture(picture);
    drawLine();
}

void SliceView::leave(const QString& words)
{
    scan_.reset();
    line_.reset();
    clearPicture(words);
}

void SliceView::setLine(const std::optional<MeasuredLine>& line)
{
    line_ = line;
    drawLine();
}

void SliceView::drawLine()
{
    const bool there = line_ && scan_ && !image().isNull();
    setCalliper(there ? inSlice(*line_, shown_, scan_->files.volume().grid) : std::nullopt);
}

}  // namespace vicon::viewer
