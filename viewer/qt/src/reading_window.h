#pragma once

#include <QElapsedTimer>
#include <QMainWindow>
#include <QTimer>
#include <optional>
#include <set>

#include "case_session.h"
#include "marker_table.h"
#include "navigation_panel.h"
#include "peeling_panel.h"
#include "picture_view.h"
#include "seen_keeper.h"
#include "slice_view.h"
#include "studio.h"

class QComboBox;
class QLabel;

namespace vicon::viewer {

class CoveragePanel;

/// A case in reading: the endoscopic view, three slices and the colon's projection, all at one place, with the
/// controls of flight, the markers and the look below the wall.
class ReadingWindow : public QMainWindow {
    Q_OBJECT
public:
    ReadingWindow(const ReadingServices& services, const WorklistRow& row);
    ~ReadingWindow() override;

    const CaseSession& session() const { return session_; }

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void changeEvent(QEvent* event) override;
    void closeEvent(QCloseEvent* event) override;

private:
    // reading_layout.cpp
    void buildViews();
    QWidget* buildSide();
    QWidget* buildTop();
    void enlarge(QWidget* view);
    void addActions();
    void showKeys();

    // reading_window.cpp
    void connectAll();
    void scanOpened();
    void restorePlace();
    void savePlace();
    void tick();
    void moved(bool still);
    void drawEndoscopic(bool still);
    void drawOverview();
    void showPlace();
    void markersChanged();
    void tell(const QString& message);
    void warn(const QString& message);

    // reading_keys.cpp
    void lookAt(Point3 point);
    void flyTo(const Marker& marker);
    void clickedEndoscopic(Pixel at, Qt::KeyboardModifiers modifiers);
    void clickedSlice(Point3 point, Qt::KeyboardModifiers modifiers);
    void clickedOverview(Pixel at, Qt::KeyboardModifiers modifiers);
    bool placed(Point3 point, Qt::KeyboardModifiers modifiers, bool on_wall = false);
    void setPickCursor(bool on);
    void pair(const Marker& marker);
    void arm(std::optional<MarkerColor> color);
    void setMode(NavigationMode mode);
    void fly(int direction);
    void turnAbout();
    void updateSteering();
    void snapshot(bool to_clipboard);

    // reading_measure.cpp
    void startMeasuring();
    void stopMeasuring();
    bool measuredAt(Point3 point, bool on_wall);
    void showMeasured(const WallDistance& size);
    void drawMeasured();
    std::optional<Marker> markerBeside(const std::vector<Point3>& way) const;

    // reading_coverage.cpp
    void connectCoverage();
    void beginPass();
    void listUnseen();
    void showSeen();
    void keepSeen();

    SnapshotRequest request(const QSize& size) const;
    SnapshotResult place() const;
    Navigator* navigator() const { return session_.scan() ? &session_.scan()->navigator : nullptr; }

    CaseSession session_;
    Studio studio_;
    SeenKeeper seen_keeper_;
    PictureView *endoscopic_, *overview_;
    SliceView *transverse_, *coronal_, *sagittal_;
    QWidget* side_ = nullptr;
    QWidget* enlarged_ = nullptr;
    MarkerTable* table_;
    NavigationPanel* navigation_;
    PeelingPanel* peeling_;
    CoveragePanel* coverage_;
    QComboBox *scan_choice_, *window_choice_;
    QLabel *warning_, *notice_, *seen_text_;
    QTimer timer_, still_, poll_, keep_seen_;
    QElapsedTimer clock_;
    Pose shown_pose_;
    Lens shown_lens_;
    PlaneView shown_overview_;
    bool overview_shown_ = false;
    std::optional<Point3> focus_;  // what was clicked; else the place on the path
    std::optional<MarkerColor> armed_;
    std::optional<Pixel> lens_at_;                 // where the mouse was last
    std::optional<std::string> moving_, pairing_;  // markers, by id: what they are may change meanwhile
    /// Two clicks that are being measured.
    struct Measuring {
        std::vector<Point3> ends;
        bool on_wall = true;  ///< both; else straight, as in a slice
    };
    std::optional<Measuring> measuring_;
    std::vector<Point3> measured_way_;
    std::set<int> keys_;
    QPointF mouse_steering_;
    double wanted_fraction_ = -1;  // of the path, when the scan is changed
    double view_angle_deg_ = 90;
};

}  // namespace vicon::viewer
