#pragma once

#include <memory>

#include "session/open_scan.h"
#include "slices/measured_line.h"
#include "vicon/viewer/scene/slice_pictures.h"
#include "widgets/picture_view.h"
#include "widgets/worker_with.h"

namespace vicon::viewer {

/// A slice through the point that is looked at. The wheel scrolls, with Control it zooms, the middle or right button
/// pans, a double click enlarges.
class SliceView : public PictureView {
    Q_OBJECT
public:
    SliceView(SlicePlane plane, const QString& name, QWidget* parent = nullptr);

    /// Draws the slice through `point`, with the crosshair there.
    void look(std::shared_ptr<OpenScan> scan, Point3 point, const Pose& pose, std::vector<Marker> markers);
    void setWindow(const WindowLevel& window);
    /// Shows the densities without tagging, where that was taken out.
    void setCleansed(bool cleansed);
    /// The whole scan, centred on the point.
    void resetView();
    /// Of the picture that is shown: a click means a place in it.
    const PlaneView& shown() const { return shown_; }
    /// A measured line, drawn where the slice passes it.
    void setLine(const std::optional<MeasuredLine>& line);
    /// The scan is no longer read.
    void leave(const QString& words);

signals:
    void pointClicked(vicon::Point3 point, Qt::KeyboardModifiers modifiers);
    /// Of the measured line, to a place in the slice.
    void lineDragged(int end, vicon::Point3 to, bool released);
    void failed(const QString& message);

protected:
    /// The point that is looked at.
    QPoint home() const override;

private:
    void draw();
    void show(const Picture& picture, const PlaneView& view);
    void drawLine();
    void scroll(int steps, Qt::KeyboardModifiers modifiers);

    SlicePlane plane_;
    std::shared_ptr<OpenScan> scan_;
    SliceRequest request_;
    Vector3 pan_mm_;  // of the picture's middle from the point, across the plane as well
    double zoom_ = 1;
    PlaneView shown_;  // that of the picture; request_.view is the one asked for
    std::optional<MeasuredLine> line_;
    WorkerWith<SlicePictures> worker_{this};
};

}  // namespace vicon::viewer
