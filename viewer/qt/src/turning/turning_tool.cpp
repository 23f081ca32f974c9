#include "turning/turning_tool.h"

#include <QAction>
#include <algorithm>

#include "reading/reading.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {
constexpr const char* kTurned = "turned";
}

TurningTool::TurningTool(Reading& reading) : ReadingTool(reading)
{
    connect(&worker_, &Worker::failed, &reading_, &Reading::warn);
}

void TurningTool::addTo(ReadingLayout& layout)
{
    PictureView* overview = reading_.views().overview();
    overview->setToolTip(
        tr("Click: go there. Drag: turn. Wheel: enlarge. Right button: move. Z: from the front again. Double click: "
           "this view alone."));
    layout.addAction(ReadingMenu::view, tr("Projection from the front again"), QKeySequence("Z"),
                     [this] { fromFront(); });
    connect(overview, &PictureView::dragged, this, &TurningTool::dragged);
    connect(overview, &PictureView::dragEnded, &reading_, &Reading::drawSmoothlySoon);
    connect(overview, &PictureView::turned, this, &TurningTool::enlarge);
    connect(overview, &PictureView::clicked, this, &TurningTool::clicked);
    connect(overview, &PictureView::resized, this, [this] { draw(true); });
}

void TurningTool::scanLeft()
{
    giveUp();
}

void TurningTool::stop()
{
    giveUp();
    worker_.end();
}

void TurningTool::giveUp()
{
    worker_.giveUp(kTurned);
    shown_.reset();
    reading_.views().overview()->setNote({});
}

void TurningTool::dragged(QPointF by, Qt::MouseButton button)
{
    const QSize size = reading_.views().overview()->pictureSize();
    if (button == Qt::LeftButton) {
        view_.turn({by.x(), by.y()}, std::min(size.width(), size.height()) / 2.0);
    } else if (shown_) {
        const double mm = shown_->view.mm_per_pixel;
        view_.move({by.x() * mm, by.y() * mm});
    }
    turnedBy(false);
}

void TurningTool::enlarge(int steps)
{
    view_.zoom(steps, {});
    turnedBy(false);
}

void TurningTool::turnedBy(bool still)
{
    if (!reading_.scan())
        return;
    reading_.setOverviewTurned(true);
    draw(still);
    reading_.drawSmoothlySoon();
}

void TurningTool::fromFront()
{
    view_.reset();
    giveUp();
    reading_.setOverviewTurned(false);
}

void TurningTool::draw(bool still)
{
    PictureView* overview = reading_.views().overview();
    if (!reading_.scan() || view_.fromFront() || !overview->isVisible())
        return;
    const QSize size = overview->pictureSize();
    const EndoscopicRequest now = reading_.requestFor(*reading_.scan(), reading_.navigator()->state(), size, still);
    TurnedRequest request;
    request.width = size.width();
    request.height = size.height();
    request.pixel_ratio = overview->devicePixelRatioF();
    request.text_px = overview->textHeight_px();
    request.view = view_;
    request.eye = now.place;
    request.markers = now.snapshot.markers;
    request.priors = now.snapshot.priors;
    request.caption = now.snapshot.caption;
    request.still = still;
    if (!shown_)
        overview->setNote(tr("being drawn ..."));
    if (still)
        worker_.giveUp(kTurned);  // what is drawn while the hand moves is shown, or the body would stand still
    worker_.postTask(kTurned, [this, scan = reading_.sharedScan(), request](Progress& wanted) mutable -> Worker::Work {
        request.seen = scan->coverage.seenTriangles();
        auto drawn = std::make_shared<TurnedPicture>(turnedPicture(scan->files, request, wanted));
        return [this, drawn] {
            shown_ = *drawn;
            reading_.views().overview()->setNote({});
            reading_.views().overview()->showPicture(drawn->picture);
        };
    });
}

void TurningTool::clicked(Pixel at, Qt::KeyboardModifiers modifiers)
{
    if (view_.fromFront() || !shown_ || !reading_.navigator())
        return;
    const auto point = shown_->pointAt(reading_.scan()->files.cells(), at);
    if (!point)
        return;
    if (reading_.interaction().inUse<Measure>()) {
        reading_.warn(tr("From outside nothing is measured: measure in the view from inside or in a slice."));
        return;
    }
    reading_.rememberPlace();
    const OpenScan& scan = *reading_.scan();
    const ViewPose view = poseForPoint(scan.files.skeleton(), scan.files.frames(), scan.lumen, *point);
    const SnapshotResult from{view.pose, view.station_mm, view.clearance_mm, view.sees_target};
    if (!reading_.click({scan, from, *point, modifiers, true}))
        reading_.lookAt(*point);
}

}  // namespace vicon::viewer
