#pragma once

#include <QObject>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "reading/reading_tool.h"
#include "reading/reading_views.h"
#include "session/case_session.h"
#include "session/drawing_thread.h"
#include "widgets/rest_timer.h"

namespace vicon::viewer {

/// What is read and how it is shown: the case, the open scan, the place in it that is looked at, and the pictures of
/// that place. Tools act on it, and are told what happens; it knows none of them by name.
class Reading : public QObject {
    Q_OBJECT
public:
    Reading(const ReadingServices& services, const WorklistCase& row, ReadingViews& views, QObject* parent);

    /// Once, before a scan is opened; they outlive whatever is called here.
    void setTools(std::vector<ReadingTool*> tools);

    CaseSession& session() { return session_; }
    const CaseSession& session() const { return session_; }
    DrawingThread& drawing() { return drawing_; }
    ReadingViews& views() { return views_; }
    /// Nothing while no scan is open.
    OpenScan* scan() const { return session_.scan(); }
    std::shared_ptr<OpenScan> sharedScan() const { return session_.sharedScan(); }
    Navigator* navigator() const { return scan() ? &scan()->navigator : nullptr; }
    const OrganWords& organWords() const { return scan()->files.words(); }
    /// What the endoscopic picture that is shown was made of.
    const ShownPicture& shown() const { return shown_; }
    /// The projection's; nothing until it is drawn.
    const PlaneView* shownOverview() const { return shown_overview_ ? &shown_overview_->view : nullptr; }

    // Said to the reader.
    void say(const QString& message) { emit said(message); }
    /// Stays until the next one; empty: none.
    void warn(const QString& message) { emit warned(message); }

    // The place.
    /// Of the eye.
    SnapshotResult place() const;
    /// The eye moved, or the pictures look otherwise. @param still it stays there: drawn smoothly
    void moved(bool still);
    /// The eye moves on by itself; the point that was looked at is left.
    void flewOn();
    /// The eye goes there. @param looked_at_mm the slices show this point, zoomed ones in their middle
    void lookFrom(const ViewPose& view, Point3 looked_at_mm);
    /// The slices show the point, zoomed ones in their middle; where it is near the lumen the eye goes there.
    void lookAt(Point3 point);
    void showMarker(const Marker& marker);
    /// Another pass begins: what was seen before it can be told from what is seen in it.
    void beginPass();
    /// The marker of a scan that is nearest to what was measured, within kMeasureNear_mm.
    /// @param away_mm how far from it a place lies
    std::optional<Marker> markerNear(const std::string& scan_id, const std::function<double(Point3)>& away_mm) const;
    /// What is measured; each view of its scan draws it.
    const std::optional<MeasuredLine>& line() const { return line_; }
    void setLine(const std::optional<MeasuredLine>& line);

    // The pictures.
    EndoscopicRequest requestFor(const OpenScan& scan, const NavigationState& at, const QSize& size, bool still) const;
    void drawEndoscopic(bool still);
    /// The projection is drawn by a tool; else from the front.
    void setOverviewTurned(bool on);
    /// The projection, unless a tool draws it. @param still what was reviewed is painted on it as it is now
    void drawOverview(bool still);
    /// As soon as nothing has moved for a while everything is drawn smoothly.
    void drawSmoothlySoon() { still_.start(); }

    // Clicks (clicks.cpp).
    Interaction& interaction() { return interaction_; }
    /// The next click is for this; what another tool shows is gone.
    void begin(const ToolInUse& tool, const QString& prompt);
    void endTool() { begin(Idle{}, {}); }
    /// Views show whether a click is awaited.
    void toolChanged();
    /// A double click in the view leaves the eye where it was before the first of the two.
    void takeBackClicksIn(const PictureView* view);
    /// False where the click only shows the point.
    bool click(const ClickedPoint& point);
    /// A point of the wall of the scan that is read, chosen from outside, seen from where the eye would look at it.
    ClickedPoint wallPoint(Point3 point, Qt::KeyboardModifiers modifiers = {}) const;
    void giveUp();

    // Steps.
    void undo();
    void redo();
    bool canUndo() const;
    bool canRedo() const;

    // Scans.
    void changeScan(const ScanRequest& request);
    /// The scan asked for is open.
    void arrive(const Arrival& arrival);
    /// The scan asked for is not opened.
    void stay();
    void useWords(const OrganWords& words);
    bool redoesScan() const;
    /// What was kept of an earlier reading.
    void restore();
    /// What was changed since it was restored or kept. @param more what else the reader finds again
    void keep(const QVariantMap& more = {});
    /// What runs is stopped; nothing is drawn any more.
    void stop();

signals:
    void said(const QString& message);
    void warned(const QString& message);
    void scanWanted(const vicon::viewer::ScanRequest& request);
    /// In any view, or no longer.
    void awaitingClick(bool on);
    void endoscopicShown();
    /// From the front, of the scan that is read.
    void overviewShown();
    /// Of all slices.
    void sliceLookChanged(const vicon::viewer::SliceLook& look);
    void lineChanged();
    /// An end of the line, 0 or 1, to a place in a view of its scan; nothing where that shows no wall.
    void lineDragged(int end, const std::optional<vicon::viewer::ClickedPoint>& to, vicon::viewer::GripDrag drag);
    /// All slices show densities without tagging, where that was taken out, or as acquired.
    void cleansedChanged(bool cleansed);
    /// By notches of the mouse wheel.
    void stepWanted(int steps);
    /// In slices across this direction, along the lumen.
    void trackWanted(vicon::Vector3 across, int slices);
    /// By device pixels, with the mouse in a slice.
    void windowDragged(QPointF by);
    /// Along the way that is flown.
    void jumpWanted(double station_mm);
    /// Beside the marker that is shown this one of the other scan, which may be the same finding.
    void partnerWanted(const vicon::Marker& partner);
    void historyChanged();

private:
    void connectSession();
    void connectViews();
    void rememberPlace();
    void takeBackClick();
    void markersChanged();
    void showEndoscopic(const Picture& picture, const ShownPicture& shown);
    void clickedEndoscopic(Pixel at, Qt::KeyboardModifiers modifiers);
    void clickedSlice(SliceView& slice, Point3 point, Qt::KeyboardModifiers modifiers);
    /// As lookFrom() and lookAt(); zoomed slices stay as they are while the point is well inside them.
    void goTo(const ViewPose& view, Point3 looked_at_mm);
    void goTo(Point3 point);
    void centreSlices();
    /// Those of the scan that was read.
    void clearPictures();
    QVariantMap kept() const;
    void rememberFound();
    void sayWhatIsDrawn();
    void sayWhereOverviewIs();
    void showPlace();
    SnapshotRequest snapshotOf(const OpenScan& scan, const QSize& size) const;

    ReadingViews& views_;
    std::vector<ReadingTool*> tools_;
    CaseSession session_;
    DrawingThread drawing_;
    Worker settings_worker_{this};
    ShownPicture shown_;
    ChosenPeel asked_peel_;  // of the picture asked for last
    Point3 asked_eye_mm_;    // likewise
    std::optional<ShownProjection> shown_overview_;
    bool overview_turned_ = false;
    std::optional<Point3> looked_at_mm_;  // what was clicked; else the eye's place
    /// What the reader saw before the click in a view.
    struct PlaceBefore {
        Navigator::Place eye;
        std::optional<Point3> looked_at_mm;
    };
    std::optional<PlaceBefore> before_click_;
    std::optional<MeasuredLine> line_;
    QVariantMap found_;  // as restored or kept last
    bool scan_was_open_ = false;
    Interaction interaction_;
    RestTimer still_;
};

}  // namespace vicon::viewer
