#include "turning/turning_tool.h"

#include <QAction>
#include <algorithm>

#include "reading/reading.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {
constexpr const char* kTurned = "turned";
constexpr double kOnWall_mm = 3;  // an end in a slice need not lie on the wall: as in the view from inside
}  // namespace

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
    connect(overview, &PictureView::endDragged, this, &TurningTool::endDragged);
    connect(&reading_, &Reading::lineChanged, this, &TurningTool::drawLine);
    connect(&reading_, &Reading::overviewShown, this, &TurningTool::drawLine);
}

void TurningTool::scanOpened(const Arrival&)
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

const TurnedPicture* TurningTool::shown() const
{
    return shown_ && reading_.scan() && shown_of_.lock() == reading_.sharedScan() ? &*shown_ : nullptr;
}

void TurningTool::dragged(QPointF by, Qt::MouseButton button)
{
    const QSize size = reading_.views().overview()->pictureSize();
    if (button == Qt::LeftButton) {
        view_.turn({by.x(), by.y()}, std::min(size.width(), size.height()) / 2.0);
    } else if (const auto* drawn = shown()) {
        const double mm = drawn->view.mm_per_pixel;
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

void TurningTool::sayWhereItIs()
{
    PictureView& view = *reading_.views().overview();
    if (shown())
        view.noteWhereElsewhere(shown_eye_mm_, reading_.place().pose.eye_mm);
    else if (!view.image().isNull())
        view.setNote(tr("being drawn ..."));
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
    sayWhereItIs();
    if (still)
        worker_.giveUp(kTurned);  // what is drawn while the hand moves is shown, or the body would stand still
    worker_.postTask(kTurned, [this, scan = reading_.sharedScan(), request](Progress& wanted) mutable -> Worker::Work {
        request.seen = scan->coverage.seenTriangles();
        auto drawn = std::make_shared<TurnedPicture>(turnedPicture(scan->files, request, wanted));
        return [this, scan, drawn, eye_mm = request.eye.pose.eye_mm] {
            if (scan != reading_.sharedScan())
                return;  // another one is read by now
            shown_ = *drawn;
            shown_of_ = scan;
            shown_eye_mm_ = eye_mm;
            reading_.views().overview()->showPicture(drawn->picture);
            sayWhereItIs();
            drawLine();
        };
    });
}

void TurningTool::clicked(Pixel at, Qt::KeyboardModifiers modifiers)
{
    const auto* drawn = shown();
    if (view_.fromFront() || !drawn)
        return;
    const auto point = drawn->pointAt(reading_.scan()->files.cells(), at);
    if (!point)
        return;
    if (reading_.interaction().inUse<Measure>()) {
        reading_.warn(tr("From outside nothing is measured: measure in the view from inside or in a slice."));
        return;
    }
    if (!reading_.click(reading_.wallPoint(*point, modifiers)))
        reading_.lookAt(*point);
}

// From the front the organ is translucent: a place of the picture is no point of the wall.
void TurningTool::endDragged(int end, Pixel at, GripDrag drag)
{
    const auto* drawn = shown();
    if (!drawn) {
        if (drag == GripDrag::released)
            reading_.warn(tr("The projection has no depth: turn it, and drag the end there, or in another view."));
        return;
    }
    const auto point = drawn->pointAt(reading_.scan()->files.cells(), at);
    emit reading_.lineDragged(end, point ? std::optional(reading_.wallPoint(*point)) : std::nullopt, drag);
}

void TurningTool::drawLine()
{
    PictureView* overview = reading_.views().overview();
    const auto& line = reading_.line();
    std::optional<Calliper> calliper;
    if (line && reading_.scan() && line->scan_id == reading_.scan()->record.id) {
        if (const auto* drawn = shown())
            calliper = inProjection(*line, drawn->view, [&](Point3 p) {
                return drawn->hides(reading_.scan()->files.cells(), p, kOnWall_mm);
            });
        else if (const PlaneView* view = reading_.shownOverview())
            calliper = inProjection(*line, *view);
    }
    overview->setCalliper(calliper);
}

}  // namespace vicon::viewer
