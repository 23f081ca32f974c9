#pragma once

#include <QElapsedTimer>
#include <QMainWindow>
#include <QTimer>
#include <optional>
#include <set>

#include "case_session.h"
#include "corrector.h"
#include "marker_table.h"
#include "navigation_panel.h"
#include "peeling_panel.h"
#include "picture_view.h"
#include "seen_keeper.h"
#include "slice_view.h"
#include "studio.h"
#include "vicon/viewer/model/interaction.h"
#include "vicon/viewer/model/scan_opening.h"

class QAction;
class QActionGroup;
class QComboBox;
class QLabel;
class QMenu;
class QSplitter;
class QTabWidget;

namespace vicon::viewer {

class BesideView;
class ColonPanel;
class CoveragePanel;
class FilmMaker;
class SecondWindow;

/// A case in reading: the endoscopic view, three slices and the colon's projection, all at one place, with the
/// controls of flight, the markers and the look below the wall.
class ReadingWindow : public QMainWindow {
    Q_OBJECT
public:
    ReadingWindow(const ReadingServices& services, const WorklistCase& row);
    ~ReadingWindow() override;

    const CaseSession& session() const { return session_; }
    /// As the worklist shows the case by now: scans that became ready are offered, one that was done again for another
    /// reader is shown anew.
    void renew(const WorklistCase& row);

signals:
    /// The window is gone; it deletes itself when its threads have ended.
    void closed();

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void changeEvent(QEvent* event) override;
    void closeEvent(QCloseEvent* event) override;

private:
    void end();
    // reading_layout.cpp
    void buildViews();
    QWidget* buildSide();
    QWidget* buildTop();
    void enlarge(QWidget* view);
    void addActions();

    // reading_focus.cpp
    void orderTabs();
    void notAfterAll();
    void goToList();
    void enlargeFocused();
    void showKeys();

    // reading_window.cpp
    void connectAll();
    void tick();
    bool waitsForPicture() const;
    void moved(bool still);
    void drawEndoscopic(bool still);
    void drawOverview();
    void showPlace();
    void markersChanged();
    void showHistory();
    void undo();
    void redo();
    void tell(const QString& message);
    void warn(const QString& message);

    // reading_opening.cpp
    void connectOpening();
    /// What is read now is left for the scan that is asked for.
    void changeScan(const ScanRequest& request);
    void openScan(const ScanRequest& request);
    void offer(const std::vector<ScanRecord>& scans);
    void openFirst(const std::vector<ScanRecord>& scans);
    void takeOver(const WorklistScan& row);
    void scanOpened();
    void cancelOpening();
    void stayWhereOneIs();

    // reading_place.cpp
    void savePlace();
    void restorePlace(const Arrival& arrival);
    void saveLooks();
    void restoreLooks();

    // reading_keys.cpp
    void lookAt(Point3 point);
    void flyTo(const Marker& marker);
    void clickedEndoscopic(Pixel at, Qt::KeyboardModifiers modifiers);
    void clickedSlice(Point3 point, Qt::KeyboardModifiers modifiers);
    void clickedOverview(Pixel at, Qt::KeyboardModifiers modifiers);
    /// @param from the view in which the point was chosen
    bool placed(const OpenScan& scan, const SnapshotResult& from, Point3 point, Qt::KeyboardModifiers modifiers,
                bool on_wall = false);
    /// What lies on the wall at a pixel of an endoscopic picture.
    static std::optional<Point3> wallAt(const OpenScan& scan, const Studio::Shown& shown, Pixel at);
    void setPickCursor(bool on);
    /// What a click means is done; false where it shows the point.
    bool act(const ClickMeaning& meaning, const OpenScan& scan, const SnapshotResult& from, Point3 point);
    void showMarker(const Marker& marker);
    void addMarker(MarkerColor color, const OpenScan& scan, const SnapshotResult& from, Point3 point);
    void moveMarker(const std::string& id, Point3 point);
    void refuse(const Refuse& refusal);
    void pair(const Marker& marker);
    void startPlacing(MarkerColor color);
    void startMoving(const Marker& marker);
    /// The tool that the next click is for; what another one shows is gone.
    void begin(const ToolInUse& tool, const QString& prompt);
    void endTool() { begin(Idle{}, {}); }
    /// Where a click is awaited, a cross is shown.
    void showTool();
    void setMode(NavigationMode mode);
    void fly(int direction);
    void turnAbout();
    /// Looking into the colon: the way back is what is flown next.
    void goToEnd(Heading end);
    void sayWhereItIsNarrow(double wanted_mm);
    void updateSteering();
    void snapshot(bool to_clipboard);

    // reading_measure.cpp
    void startMeasuring();
    void measure(const MeasureBetween& size);
    void showMeasured(const WallDistance& size, const std::optional<PlaneSize>& plane);
    void drawMeasured();
    std::optional<Marker> markerBeside(const std::vector<Point3>& way) const;

    // reading_biopsy.cpp
    void connectBiopsy();
    void startCircling();
    void forgetCircle();
    void circledAt(Pixel centre, double radius_px);
    void showBiopsy(const DensitySample& biopsy);
    /// Peels where the circle is, in a picture from this eye.
    void fillCircle(SnapshotRequest& request, const Pose& pose) const;

    // reading_coverage.cpp
    void connectCoverage();
    void beginPass();
    void listUnseen();
    void showSeen();
    void keepSeen();
    bool paintsSeen() const;

    // reading_corrections.cpp
    void connectCorrections();
    void correct(const OpenScan& scan, Correction kind, Point3 point);
    void sayWhatIsNotAdded();

    // reading_files.cpp
    void chooseMarkerFile(bool to_save);
    void showMarkerInformation();
    void connectFilm();
    void film();

    // reading_screens.cpp
    void addScreens(QMenu* menu);
    void setTwoScreens(bool on);
    void placeSecondWindow();
    void saveSecondWindow();

    // reading_ways.cpp
    /// The number of the tip that was chosen last; below 0: the farthest.
    int wayOf(const std::string& scan_id) const;
    void showWays();
    /// @param to where the eye is then; else the place on it that is nearest to where the eye is now
    void takeWay(int tip, std::optional<Point3> to);
    void clickedTree(const SkeletonTree& tree, Pixel at, Qt::KeyboardModifiers modifiers);

    // reading_words.cpp
    /// For the organ of the open scan.
    const OrganWords& organWords() const { return session_.scan()->files.words(); }
    void useWords(const OrganWords& words);
    void offerWindows(const std::string& organ);
    void showPictureTip();

    // reading_looks.cpp
    void addLooks(QMenu* menu);
    void setAngle(double angle_deg);
    Studio::Wish wishFor(const OpenScan& scan, const NavigationState& at, const QSize& size, bool still) const;

    // reading_beside.cpp
    void connectBeside();
    void setBeside(bool on);
    NavigationState besidePlace() const;
    void drawBeside(bool still);
    void clickedBeside(Pixel at, Qt::KeyboardModifiers modifiers);
    /// In the other scan's view, where it is open.
    void showPairOf(const Marker& marker);
    static ViewPose viewFor(const OpenScan& scan, const Marker& marker);
    static double corresponding_mm(const OpenScan& from, double station_mm, const OpenScan& to);

    SnapshotRequest request(const OpenScan& scan, const QSize& size) const;
    SnapshotResult place() const;
    Navigator* navigator() const { return session_.scan() ? &session_.scan()->navigator : nullptr; }

    CaseSession session_;
    Studio studio_;
    SeenKeeper seen_keeper_;
    Corrector corrector_;
    PictureView *endoscopic_, *overview_;
    SliceView *transverse_, *coronal_, *sagittal_;
    QSplitter *columns_ = nullptr, *slices_ = nullptr;
    QByteArray columns_on_one_;  // their widths, while two screens are used
    static constexpr const char* kColumns = "window/columns";
    QTabWidget* lists_ = nullptr;
    QActionGroup* lights_ = nullptr;
    QWidget* side_ = nullptr;
    QWidget* opening_ = nullptr;
    SecondWindow* second_ = nullptr;  // the slices and the projection are in it
    QWidget* enlarged_ = nullptr;
    MarkerTable* table_;
    NavigationPanel* navigation_;
    PeelingPanel* peeling_;
    CoveragePanel* coverage_;
    ColonPanel* colon_;
    FilmMaker* film_maker_ = nullptr;
    BesideView* beside_;
    QAction *compare_ = nullptr, *structure_ = nullptr, *occlusion_ = nullptr, *two_screens_ = nullptr;
    QAction *to_first_end_, *to_last_end_;
    QComboBox *scan_choice_, *way_choice_, *window_choice_;
    QString kept_window_;  // of the last reading, until the scan and with it the organ are known
    QLabel *warning_, *notice_, *seen_text_;
    QTimer timer_, still_, poll_, keep_seen_;
    QElapsedTimer clock_;
    Studio::Shown shown_;
    PlaneView shown_overview_;
    bool overview_shown_ = false;
    std::optional<Point3> focus_;  // what was clicked; else the place on the path
    Interaction interaction_;
    std::optional<Pixel> lens_at_;  // where the mouse was last
    std::vector<Point3> measured_way_;
    /// What was circled on the wall; it stays there while the eye moves.
    struct Circle {
        Point3 centre_mm;
        double radius_mm = 0;
    };
    std::optional<Circle> circle_;
    std::set<int> keys_;
    QPointF mouse_steering_;
    ScanOpening scan_opening_;
    std::shared_ptr<OpenScan> left_;        // the scan that was read when another was asked for
    std::optional<ViewPose> beside_place_;  // the partner of the marker that is shown; else what corresponds
    std::optional<Point3> beside_focus_;    // that partner
    /// What is being done again for this reader.
    struct Corrected {
        std::string scan_id;
        Correction kind = Correction::add;
        Point3 at_mm;
    };
    std::optional<Corrected> corrected_;
    Studio::Shown beside_shown_;
    Worker settings_worker_{this};
    std::vector<Worker*> workers_;  // once the window is closed
    double view_angle_deg_ = 90;
    double lamp_reach_mm_ = kUsualLampReach_mm;
};

}  // namespace vicon::viewer
