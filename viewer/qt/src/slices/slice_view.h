#pragma once

#include <memory>

#include "session/open_scan.h"
#include "slices/measured_line.h"
#include "vicon/viewer/model/hanging.h"
#include "vicon/viewer/scene/slice_pictures.h"
#include "widgets/picture_view.h"
#include "widgets/worker_with.h"

namespace vicon::viewer {

/// A slice through the point that is looked at. The wheel scrolls or follows the lumen, with Control it zooms and the
/// cross stays where it is; the left button sets the window, the middle or right one pans; a double click enlarges.
class SliceView : public PictureView {
    Q_OBJECT
public:
    SliceView(SlicePlane plane, const QString& name, QWidget* parent = nullptr);
    void setPlane(SlicePlane plane);

    /// What a zoomed picture does when another point is looked at: the cross stays where it is in the picture, or the
    /// picture stays where it is as long as the cross is well inside it.
    enum class Move { with_the_point, as_needed };
    /// Draws the slice through `point`, with the crosshair there.
    void look(std::shared_ptr<OpenScan> scan, Point3 point, const Pose& pose, std::vector<Marker> markers,
              std::vector<PriorPlace> priors = {}, Move how = Move::with_the_point);
    void setLook(const SliceLook& look);
    /// The eye flies along the centreline, and the picture shown is of a place farther than this from there.
    bool isBehind(const std::shared_ptr<OpenScan>& scan, const NavigationState& now, double most_mm) const;
    /// Shows the densities without tagging, where that was taken out.
    void setCleansed(bool cleansed);
    /// Zoomed, the picture has the point in its middle.
    void centreOnPoint();
    /// The whole scan, centred on the point.
    void resetView();
    /// A pixel is a voxel, or two by two of them, around the place looked at; until it is zoomed or resetView().
    enum class Resolution { acquired, half };
    void setResolution(Resolution of);
    /// To the acquired resolution around the place looked at; from there to half of it or all of the slice, as before.
    void toAcquiredAndBack();
    /// Of the picture that is shown: a click means a place in it.
    const PlaneView& shown() const { return shown_; }
    /// Where the cross is.
    Point3 point_mm() const { return request_.point_mm; }
    /// A measured line, drawn where the slice passes it; not where it lies in another scan.
    void setLine(const std::optional<MeasuredLine>& line);
    /// Where a density was taken, drawn where the slice cuts it.
    void setSampled(const std::optional<SampledBall>& ball);
    /// The scan is no longer read.
    void leave(const QString& words);
    /// Where the lines cross in the picture that is shown, which may still be that of an earlier place.
    QPoint home() const override;

signals:
    void pointClicked(vicon::Point3 point, Qt::KeyboardModifiers modifiers);
    /// Of the measured line, to a place in the slice.
    void lineDragged(int end, vicon::Point3 to, vicon::viewer::GripDrag drag);
    /// The wheel was turned while the lumen is followed.
    void trackWanted(vicon::Vector3 across, int slices);
    void windowDragged(QPointF by);
    void failed(const QString& message);

protected:
    void showEvent(QShowEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;

private:
    SliceAxes axes() const;
    void draw();
    /// The one asked for, with its middle off from where it would be.
    PlaneView viewWith(Vector3 pan_mm) const;
    /// That keeps the picture where it was. @param before that view @param point_before where its cross was
    Vector3 panFrom(const PlaneView& before, Point3 point_before, Move how) const;
    void zoom(int notches);
    void show(const Picture& picture, const SliceRequest& of);
    void drawLine();
    void readAt(std::optional<Pixel> pointer);
    QString densityAt(Pixel at) const;
    void scroll(int steps, Qt::KeyboardModifiers modifiers);

    std::shared_ptr<OpenScan> scan_;
    SliceRequest request_;
    // Of the picture's middle from where it would be, the scan's middle or, zoomed, the point; across the plane as
    // well.
    Vector3 pan_mm_;
    double zoom_ = 1;
    bool half_before_ = false;  // as the acquired resolution was asked for
    PlaneView shown_;           // that of the picture; request_.view is the one asked for
    Point3 shown_point_mm_;
    std::optional<MeasuredLine> line_;
    std::optional<SampledBall> ball_;
    std::optional<Pixel> pointer_;  // where a density is read
    WorkerWith<SlicePictures> worker_{this};
};

}  // namespace vicon::viewer
