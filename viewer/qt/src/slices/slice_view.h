#pragma once

#include <memory>

#include "session/open_scan.h"
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
    const PlaneView& shown() const { return shown_; }

signals:
    void pointClicked(vicon::Point3 point, Qt::KeyboardModifiers modifiers);
    void failed(const QString& message);

protected:
    /// The point that is looked at.
    QPoint home() const override;

private:
    void draw();
    void scroll(int steps, Qt::KeyboardModifiers modifiers);

    SlicePlane plane_;
    std::shared_ptr<OpenScan> scan_;
    SliceRequest request_;
    Vector3 pan_mm_;  // of the picture's middle from the point, across the plane as well
    double zoom_ = 1;
    PlaneView shown_;
    WorkerWith<SlicePictures> worker_{this};
};

}  // namespace vicon::viewer
