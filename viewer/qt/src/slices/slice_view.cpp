#include "slices/slice_view.h"

#include <QMouseEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "vicon/viewer/model/thick_slice.h"

namespace vicon::viewer {
namespace {

constexpr const char *kSlice = "slice", *kAhead = "next slices";

/// Across the lumen, what is farther than some 7 cm from it is of no use.
double usualZoom(SlicePlane plane)
{
    return plane == SlicePlane::across ? 3 : 1;
}

}  // namespace

SliceView::SliceView(SlicePlane plane, const QString& name, QWidget* parent) : PictureView(name, parent)
{
    request_.plane = plane;
    zoom_ = usualZoom(plane);
    setMouseTracking(true);
    connect(this, &PictureView::hovered, this, &SliceView::readAt);
    setToolTip(tr(
        "Click: look there. Wheel: scroll, or along the lumen (Q). Control and wheel: zoom. Drag: window. Right "
        "button: pan. Double click: enlarge. Shift and click: marker. Control and click: pixel for pixel, and back."));
    connect(this, &PictureView::resized, this, &SliceView::draw);
    connect(this, &PictureView::turned, this, &SliceView::scroll);
    connect(worker_.worker(), &Worker::failed, this, &SliceView::failed);
    connect(this, &PictureView::dragged, this, [this](QPointF by, Qt::MouseButton button) {
        if (button == Qt::LeftButton) {
            emit windowDragged(by);
            return;
        }
        const PlaneView& view = request_.view;
        pan_mm_ -= (view.right * by.x() + view.down * by.y()) * view.mm_per_pixel;
        draw();
    });
    connect(this, &PictureView::endDragged, this,
            [this](int end, Pixel at, GripDrag drag) { emit lineDragged(end, shown_.pointAt(at), drag); });
    connect(this, &PictureView::clicked, this,
            [this](Pixel at, Qt::KeyboardModifiers modifiers) { emit pointClicked(shown_.pointAt(at), modifiers); });
}

void SliceView::setPlane(SlicePlane plane)
{
    if (plane == request_.plane)
        return;
    request_.plane = plane;
    zoom_ = usualZoom(plane);
    pan_mm_ = {};
    draw();
}

void SliceView::look(std::shared_ptr<OpenScan> scan, Point3 point, const Pose& pose, std::vector<Marker> markers,
                     std::vector<PriorPlace> priors, Move how)
{
    const bool same_scan = scan == scan_;
    const PlaneView before = same_scan ? viewWith(pan_mm_) : PlaneView();
    const Point3 point_before = std::exchange(request_.point_mm, point);
    scan_ = std::move(scan);
    request_.pose = pose;
    if (!same_scan) {
        worker_.giveUp(kSlice);
        pan_mm_ = {};
    } else if (!(point == point_before)) {
        pan_mm_ = panFrom(before, point_before, how);
    }
    request_.markers = std::move(markers);
    request_.priors = std::move(priors);
    request_.caption = scan_->caption;
    draw();
}

void SliceView::setLook(const SliceLook& look)
{
    request_.window = look.window;
    request_.thick = look.thick;
    request_.tracks = look.tracks;
    draw();
}

bool SliceView::isBehind(const std::shared_ptr<OpenScan>& scan, const NavigationState& now, double most_mm) const
{
    return isVisible() && scan == scan_ && !image().isNull() &&
           distance(shown_point_mm_, placeInSlices(*scan, now)) > most_mm;
}

void SliceView::setCleansed(bool cleansed)
{
    request_.cleansed = cleansed;
    draw();
}

QPoint SliceView::home() const
{
    const QPoint at = scan_ ? toWidget(shown_.toPixel(shown_point_mm_)).toPoint() : rect().center();
    return rect().contains(at) ? at : rect().center();
}

void SliceView::centreOnPoint()
{
    if (zoom_ <= 1)
        return;
    pan_mm_ = {};
    draw();
}

void SliceView::resetView()
{
    pan_mm_ = {};
    zoom_ = 1;
    request_.voxels_a_pixel = 0;
    draw();
}

void SliceView::setResolution(Resolution of)
{
    pan_mm_ = {};
    zoom_ = 1;
    request_.voxels_a_pixel = of == Resolution::half ? 2 : 1;
    draw();
}

void SliceView::toAcquiredAndBack()
{
    if (request_.voxels_a_pixel != 1) {
        half_before_ = request_.voxels_a_pixel == 2;
        setResolution(Resolution::acquired);
    } else if (half_before_) {
        setResolution(Resolution::half);
    } else {
        resetView();
    }
}

void SliceView::scroll(int steps, Qt::KeyboardModifiers modifiers)
{
    if (!scan_)
        return;
    if (modifiers & Qt::ControlModifier) {
        zoom(steps);
        return;
    }
    if (request_.tracks && !(modifiers & Qt::ShiftModifier)) {
        emit trackWanted(request_.view.forward(), steps);
        return;
    }
    const auto& spacing = scan_->files.volume().grid.spacing_mm;
    pan_mm_ += request_.view.forward() * (steps * *std::min_element(spacing.begin(), spacing.end()));
    draw();
}

/// What is hidden is not drawn.
void SliceView::showEvent(QShowEvent* event)
{
    PictureView::showEvent(event);
    draw();
}

void SliceView::draw()
{
    if (!scan_ || !isVisible())
        return;
    request_.view = viewWith(pan_mm_);
    request_.pixel_ratio = devicePixelRatioF();
    request_.text_px = textHeight_px();
    if (!image().isNull())
        noteWhereElsewhere(shown_point_mm_, request_.point_mm);
    worker_.post(
        kSlice,
        [this, scan = scan_, request = request_](SlicePictures& pictures, const Progress& wanted) -> Worker::Work {
            const std::shared_ptr<const PreparedScan> files(scan, &scan->files);
            auto picture = std::make_shared<Picture>(pictures.draw(files, request, &wanted));
            worker_.post(kAhead, [](SlicePictures& ahead, const Progress& still_wanted) -> Worker::Work {
                ahead.readAhead(&still_wanted);
                return {};
            });
            return [this, picture, request] { show(*picture, request); };
        });
}

void SliceView::show(const Picture& picture, const SliceRequest& of)
{
    shown_ = of.view;
    shown_point_mm_ = of.point_mm;
    noteWhereElsewhere(shown_point_mm_, request_.point_mm);
    showPicture(picture);
    drawLine();
    readAt(pointer_);
}

void SliceView::readAt(std::optional<Pixel> pointer)
{
    pointer_ = pointer;
    setReadout(pointer && scan_ && !image().isNull() ? densityAt(*pointer) : QString());
}

/// As acquired, also where the picture is cleansed; of a slab what it takes together. MR has no densities.
QString SliceView::densityAt(Pixel at) const
{
    const PreparedScan& files = scan_->files;
    if (files.quantity() != Quantity::density)
        return {};
    PlaneView pixel = shown_;
    pixel.centre_mm = shown_.pointAt(at);
    pixel.width = pixel.height = 1;
    const float density_hu = thickSliceDensities(files.volume(), nullptr, pixel, request_.thick).front();
    if (density_hu == kPaddingHu)
        return {};
    const QString text = tr("%1 HU").arg(std::lround(density_hu));
    return request_.cleansed && files.canBeCleansed() ? tr("%1 as acquired").arg(text) : text;
}

/// While the mouse drags, what is under it is not read.
void SliceView::mouseMoveEvent(QMouseEvent* event)
{
    if (event->buttons() != Qt::NoButton)
        readAt(std::nullopt);
    PictureView::mouseMoveEvent(event);
}

void SliceView::leaveEvent(QEvent* event)
{
    readAt(std::nullopt);
    PictureView::leaveEvent(event);
}

void SliceView::leave(const QString& words)
{
    for (const char* name : {kSlice, kAhead})
        worker_.giveUp(name);
    scan_.reset();
    line_.reset();
    ball_.reset();
    clearPicture(words);
}

void SliceView::setLine(const std::optional<MeasuredLine>& line)
{
    line_ = line;
    drawLine();
}

void SliceView::setSampled(const std::optional<SampledBall>& ball)
{
    ball_ = ball;
    drawLine();
}

void SliceView::drawLine()
{
    setRing(ball_ && scan_ && !image().isNull() ? inSlice(*ball_, shown_) : std::nullopt);
    const bool there = line_ && scan_ && line_->scan_id == scan_->record.id && !image().isNull();
    setCalliper(there ? inSlice(*line_, shown_, scan_->files.volume().grid) : std::nullopt);
}

}  // namespace vicon::viewer
