#include "panorama/panorama_tool.h"

#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QMainWindow>
#include <cmath>

#include "measuring/line_from_inside.h"
#include "panorama/band_view.h"
#include "reading/reading.h"
#include "vicon/viewer/scene/cube_picture.h"
#include "widgets/kept_settings.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {
// The reader's own, whatever the case.
constexpr const char* kCube = "panorama/cube";
constexpr const char* kBand = "panorama/band";
constexpr double kCubeShare = 0.38, kBandShare = 0.27;  // of the window
}  // namespace

PanoramaTool::PanoramaTool(Reading& reading)
    : ReadingTool(reading), cube_(new PictureView(tr("Unfolded cube: all around the eye"))), band_(new BandView)
{
    cube_->setObjectName("cube");
    cube_->setToolTip(
        tr("All that lies around the eye, on the six faces of a cube. Click: look there. Wheel: on and back. Double "
           "click: alone, and back. Shift and click: marker."));
}

void PanoramaTool::addTo(ReadingLayout& layout)
{
    addCube(layout);
    addBand(layout);
    connect(&reading_, &Reading::awaitingClick, this, [this](bool on) {
        cube_->setPicking(on);
        band_->setPicking(on);
    });
}

void PanoramaTool::addCube(ReadingLayout& layout)
{
    cube_dock_ = layout.addForm(cube_, tr("Unfolded cube"));
    cube_on_ = layout.addSwitch(ReadingMenu::view, tr("Unfolded cube"), QKeySequence("U"));
    connect(cube_on_, &QAction::toggled, this,
            [this](bool on) { showDock(cube_dock_, on, Qt::Horizontal, kCubeShare); });
    connect(cube_dock_, &QDockWidget::visibilityChanged, this, [this](bool) {
        cube_on_->setChecked(!cube_dock_->isHidden());
        drawCube(true);
    });
    connect(cube_, &PictureView::resized, this, [this] { drawCube(true); });
    connect(cube_, &PictureView::clicked, this, &PanoramaTool::clickedCube);
    reading_.takeBackClicksIn(cube_);
    connect(cube_, &PictureView::enlargeWanted, this, [this] {
        cube_dock_->setFloating(!cube_dock_->isFloating());
        if (cube_dock_->isFloating())
            cube_dock_->setGeometry(cube_dock_->parentWidget()->geometry());
    });
    connect(cube_, &PictureView::turned, &reading_, [this](int steps) { emit reading_.stepWanted(steps); });
    connect(&reading_, &Reading::lineChanged, this, &PanoramaTool::drawLine);
    connect(cube_, &PictureView::endDragged, this,
            [this](int end, Pixel at, GripDrag drag) { emit reading_.lineDragged(end, cubePointAt(at), drag); });
    connect(&reading_.drawing(), &DrawingThread::cubeDrawn, this,
            [this](const Picture& picture, const ShownPicture& shown) {
                cube_under_way_ = false;
                if (shown.isOf(reading_.sharedScan())) {
                    shown_cube_ = shown;
                    cube_->showPicture(picture);
                    cube_->noteWhereElsewhere(shown.place.pose.eye_mm, cube_eye_mm_);
                    drawLine();
                }
                if (cube_is_old_)
                    drawCube(false);
            });
}

void PanoramaTool::addBand(ReadingLayout& layout)
{
    band_dock_ = layout.addForm(band_, tr("Band: the colon cut open"), Qt::BottomDockWidgetArea);
    band_on_ = layout.addSwitch(ReadingMenu::view, tr("Band (colon cut open)"), QKeySequence("Shift+B"));
    connect(band_on_, &QAction::toggled, this, [this](bool on) { showDock(band_dock_, on, Qt::Vertical, kBandShare); });
    connect(band_dock_, &QDockWidget::visibilityChanged, this, [this](bool) {
        band_on_->setChecked(!band_dock_->isHidden());
        drawBand(true);
    });
    connect(band_, &BandView::pointClicked, this, &PanoramaTool::clickedBand);
    connect(&reading_, &Reading::lineChanged, band_, [this] { band_->setLine(reading_.line()); });
    connect(band_, &BandView::endMoved, this, [this](int end, const std::optional<Point3>& to, GripDrag drag) {
        const bool there = to && reading_.scan();
        emit reading_.lineDragged(end, there ? std::optional(reading_.wallPoint(*to)) : std::nullopt, drag);
    });
    reading_.takeBackClicksIn(band_);
    connect(band_, &BandView::failed, &reading_, &Reading::warn);
}

/// With a share of the window that shows something; the reader may change it.
void PanoramaTool::showDock(QDockWidget* dock, bool on, Qt::Orientation along, double share) const
{
    if (on == !dock->isHidden())
        return;
    if (!on && dock->isAncestorOf(QApplication::focusWidget()))
        reading_.views().takeKeyboard();  // else some control would have it, and swallow the next key
    dock->setVisible(on);
    auto* window = qobject_cast<QMainWindow*>(dock->parentWidget());
    const int whole = along == Qt::Horizontal ? window->width() : window->height();
    if (on && !dock->isFloating())
        window->resizeDocks({dock}, {int(share * whole)}, along);
}

void PanoramaTool::restore()
{
    cube_on_->setChecked(keptSetting(kCube).toBool());
    band_on_->setChecked(keptSetting(kBand).toBool());
}

QVariantMap PanoramaTool::kept() const
{
    return {{kCube, cube_on_->isChecked()}, {kBand, band_on_->isChecked()}};
}

void PanoramaTool::scanLeft()
{
    band_->leave({});
}

void PanoramaTool::scanOpened(const Arrival&)
{
    const QString words =
        tr("%1: this picture is still to come").arg(QString::fromStdString(reading_.scan()->caption.position));
    shown_cube_ = {};
    cube_under_way_ = cube_is_old_ = false;
    cube_->clearPicture(words);
    band_->leave(words);
    const bool one_way = reading_.scan()->files.tree().empty() && reading_.scan()->files.hasPath();
    band_on_->setEnabled(one_way);
    if (!one_way)
        band_on_->setChecked(false);
}

void PanoramaTool::stop()
{
    band_->stop();
}

void PanoramaTool::draw(bool still)
{
    drawCube(still);
    drawBand(still);
}

// While the eye moves a cube is drawn when the one before is there: each takes as long as some pictures.
void PanoramaTool::drawCube(bool still)
{
    if (!reading_.scan() || !cube_->isVisible())
        return;
    cube_eye_mm_ = reading_.navigator()->state().pose.eye_mm;
    if (shown_cube_.isOf(reading_.sharedScan()))
        cube_->noteWhereElsewhere(shown_cube_.place.pose.eye_mm, cube_eye_mm_);
    cube_is_old_ = !still && cube_under_way_;
    if (cube_is_old_)
        return;
    EndoscopicRequest request =
        reading_.requestFor(*reading_.scan(), reading_.navigator()->state(), cube_->pictureSize(), still);
    request.snapshot.captioned = false;
    request.count_seen = still;
    cube_under_way_ = true;
    reading_.drawing().drawCube(reading_.sharedScan(), request);
}

void PanoramaTool::drawBand(bool still)
{
    if (!reading_.scan() || !band_->isVisible() || !band_on_->isEnabled())
        return;
    const EndoscopicRequest request =
        reading_.requestFor(*reading_.scan(), reading_.navigator()->state(), band_->pictureSize(), still);
    band_->look(reading_.sharedScan(),
                {request.place, reading_.navigator()->heading() == Heading::rectum, request.snapshot.markers,
                 request.snapshot.priors, request.paint_seen},
                still);
}

void PanoramaTool::drawLine()
{
    cube_->setCalliper(lineOnCube(reading_.line(), reading_.sharedScan(), shown_cube_));
}

std::optional<ClickedPoint> PanoramaTool::cubePointAt(Pixel at, Qt::KeyboardModifiers modifiers) const
{
    const auto scan = reading_.sharedScan();
    const CubeLayout layout(shown_cube_.lens.width, shown_cube_.lens.height);
    const auto face = layout.faceAt(at);
    if (!shown_cube_.isOf(scan) || !face)
        return std::nullopt;
    ShownPicture of_face = shown_cube_;
    of_face.place = faceOf(*face, shown_cube_.place);
    of_face.lens = layout.lens();
    const Pixel corner = layout.cornerOf(*face);
    const auto point = of_face.wallAt({at.x - corner.x, at.y - corner.y});
    return point ? std::optional(ClickedPoint{*scan, of_face.place, *point, modifiers, !of_face.acquired})
                 : std::nullopt;
}

void PanoramaTool::clickedCube(Pixel at, Qt::KeyboardModifiers modifiers)
{
    if (!shown_cube_.isOf(reading_.sharedScan()))
        return;
    if (const auto point = cubePointAt(at, modifiers))
        clickedWall(*point);
}

void PanoramaTool::clickedBand(Point3 point, Qt::KeyboardModifiers modifiers)
{
    if (reading_.navigator())
        clickedWall(reading_.wallPoint(point, modifiers));
}

void PanoramaTool::clickedWall(const ClickedPoint& point)
{
    const bool measuring = reading_.interaction().inUse<Measure>();
    if (!reading_.click(point) && !measuring)
        reading_.lookAt(point.at_mm);
}

}  // namespace vicon::viewer
