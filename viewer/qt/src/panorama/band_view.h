#pragma once

#include <memory>
#include <optional>

#include "session/open_scan.h"
#include "slices/measured_line.h"
#include "vicon/viewer/scene/band_picture.h"
#include "widgets/picture_view.h"
#include "widgets/wanted.h"
#include "widgets/worker_with.h"

namespace vicon::viewer {

/// The colon cut open along its length: a stretch of it that follows the eye, or all of it in rows. The wheel moves
/// along, with Control or a double click it is all or a stretch.
class BandView : public PictureView {
    Q_OBJECT
public:
    explicit BandView(QWidget* parent = nullptr);
    ~BandView() override;

    /// What is drawn over the wall, and which way a row goes.
    struct Look {
        SnapshotResult eye;
        bool from_caecum = false;
        std::vector<Marker> markers;
        std::vector<PriorPlace> priors;
        bool paint_seen = false;
    };
    /// Draws it, when it is visible.
    void look(std::shared_ptr<OpenScan> scan, const Look& look, bool still);
    /// The scan is no longer read.
    void leave(const QString& words);
    /// Nothing is drawn any more.
    void stop();
    /// What is measured, when it lies in the scan that is shown.
    void setLine(const std::optional<MeasuredLine>& line);
    void setWhole(bool whole);
    bool whole() const { return whole_; }

signals:
    /// A point of the wall.
    void pointClicked(vicon::Point3 point, Qt::KeyboardModifiers modifiers);
    /// An end of the line is dragged to a point of the wall, or beside it.
    void endMoved(int end, const std::optional<vicon::Point3>& to, vicon::viewer::GripDrag drag);
    void failed(const QString& message);

protected:
    void showEvent(QShowEvent* event) override;

private:
    /// What the thread keeps of a scan.
    struct Opened {
        std::weak_ptr<OpenScan> of;
        std::shared_ptr<const BandMap> band;
    };
    /// A picture with the band that it shows, and where it marks the eye.
    struct Shown {
        std::shared_ptr<const BandMap> band;
        BandPicture picture;
        Point3 eye_mm;
    };

    /// The line with the places of its ends, which take their time to find.
    struct PlacedLine {
        MeasuredLine line;
        std::vector<BandPlace> ends;
    };

    void placeLine();
    void drawLine();
    void draw(bool still);
    void sayWhereItIs();
    BandRequest requestNow(bool still) const;
    void show(const Shown& shown);
    void clickedAt(Pixel at, Qt::KeyboardModifiers modifiers);
    void scroll(int steps, Qt::KeyboardModifiers modifiers);
    bool shows(double station_mm) const;

    std::shared_ptr<OpenScan> scan_;
    Look look_;
    bool whole_ = false;
    std::optional<double> middle_mm_;  // of the stretch; nothing: where the eye is
    std::optional<double> eye_before_mm_;
    std::optional<Shown> shown_;
    std::optional<MeasuredLine> line_;
    std::optional<PlacedLine> placed_line_;
    std::shared_ptr<Wanted> band_wanted_, picture_wanted_;
    WorkerWith<Opened> worker_{this};
};

}  // namespace vicon::viewer
