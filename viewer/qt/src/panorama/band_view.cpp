#include "panorama/band_view.h"

#include <algorithm>
#include <cmath>

#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

constexpr double kStays_mm = 1;  // less is no movement of the eye

/// A band with the files that it looks at.
struct HeldBand {
    PreparedScan files;
    BandMap band;
};

}  // namespace

BandView::BandView(QWidget* parent) : PictureView(tr("Band: the colon cut open"), parent)
{
    setObjectName("band");
    setToolTip(
        tr("Click: look there. Wheel: along. Control and wheel, or double click: all of it, and back. Shift and click: "
           "marker. Hatched: areas are off by more than a factor of two; a length is the wall's, not the picture's."));
    connect(this, &PictureView::resized, this, [this] { draw(true); });
    connect(this, &PictureView::turned, this, &BandView::scroll);
    connect(this, &PictureView::enlargeWanted, this, [this] { setWhole(!whole_); });
    connect(this, &PictureView::clicked, this, &BandView::clickedAt);
    connect(this, &PictureView::endDragged, this, [this](int end, Pixel at, GripDrag drag) {
        emit endMoved(end, shown_ ? shown_->picture.pointAt(*shown_->band, at) : std::nullopt, drag);
    });
    connect(worker_.worker(), &Worker::failed, this, [this](const QString& message) {
        shown_.reset();
        clearPicture(message);
        update();
        emit failed(message);
    });
}

BandView::~BandView()
{
    stop();
}

void BandView::look(std::shared_ptr<OpenScan> scan, const Look& look, bool still)
{
    if (scan != scan_)
        leave({});
    scan_ = std::move(scan);
    look_ = look;
    const double eye_mm = look.eye.station_mm;
    const bool moved = !eye_before_mm_ || std::abs(*eye_before_mm_ - eye_mm) > kStays_mm;
    if (moved && !shows(eye_mm))
        middle_mm_.reset();
    if (moved)
        eye_before_mm_ = eye_mm;
    draw(still);
}

bool BandView::shows(double station_mm) const
{
    if (!middle_mm_ || !shown_)
        return false;
    const BandPage& page = shown_->picture.page;
    constexpr double kMargin = 0.1;  // what comes next is seen, too
    const double margin_mm = kMargin * page.rowLength_mm();
    return station_mm > page.rowLeast_mm(0) + margin_mm && station_mm < page.rowMost_mm(0) - margin_mm;
}

void BandView::leave(const QString& words)
{
    if (band_wanted_)
        band_wanted_->giveUp();
    if (picture_wanted_)
        picture_wanted_->giveUp();
    band_wanted_.reset();
    scan_.reset();
    shown_.reset();
    placed_line_.reset();
    middle_mm_.reset();
    eye_before_mm_.reset();
    clearPicture(words);
}

void BandView::stop()
{
    leave({});
    worker_.end();
}

void BandView::setWhole(bool whole)
{
    whole_ = whole;
    draw(true);
}

void BandView::showEvent(QShowEvent* event)
{
    PictureView::showEvent(event);
    draw(true);
}

BandRequest BandView::requestNow(bool still) const
{
    const QSize size = pictureSize();
    BandRequest request;
    request.width = size.width();
    request.height = size.height();
    request.pixel_ratio = devicePixelRatioF();
    request.text_px = textHeight_px();
    if (!whole_)
        request.middle_mm = middle_mm_.value_or(look_.eye.station_mm);
    request.from_caecum = look_.from_caecum;
    request.eye = look_.eye;
    request.markers = look_.markers;
    request.priors = look_.priors;
    request.caption = scan_->caption;
    request.still = still;
    return request;
}

void BandView::draw(bool still)
{
    if (!scan_ || !isVisible())
        return;
    if (!band_wanted_) {
        band_wanted_ = std::make_shared<Wanted>();
        clearPicture(tr("The colon is being cut open ..."));
        update();
    }
    sayWhereItIs();
    if (picture_wanted_)
        picture_wanted_->giveUp();
    picture_wanted_ = std::make_shared<Wanted>();
    worker_.post(
        "band",
        [this, scan = scan_, request = requestNow(still), look = look_, band_wanted = band_wanted_,
         wanted = picture_wanted_](Opened& opened) mutable -> Worker::Work {
            try {
                if (opened.of.lock() != scan) {
                    opened = {};
                    const auto held =
                        std::make_shared<HeldBand>(HeldBand{scan->files, bandOf(scan->files, *band_wanted)});
                    opened.band = {held, &held->band};
                    opened.of = scan;
                }
                if (look.paint_seen)
                    request.seen = scan->coverage.seenTriangles();
                BandPicture picture = bandPicture(scan->files, *opened.band, request, *wanted);
                auto shown = std::make_shared<Shown>(Shown{opened.band, std::move(picture), look.eye.pose.eye_mm});
                return [this, shown, scan] {
                    if (scan == scan_)
                        show(*shown);
                };
            } catch (const Error& e) {
                if (e.code() == ErrorCode::cancelled)
                    return {};
                throw;
            }
        });
}

void BandView::sayWhereItIs()
{
    if (shown_)
        noteWhereElsewhere(shown_->eye_mm, look_.eye.pose.eye_mm);
}

void BandView::show(const Shown& shown)
{
    shown_ = shown;
    const BandPage& page = shown.picture.page;
    if (!whole_ && page.rows == 1)
        middle_mm_ = page.rowLeast_mm(0) + page.rowLength_mm() / 2;
    showPicture(shown.picture.picture);
    sayWhereItIs();
    drawLine();
    if (!placed_line_)
        placeLine();
}

void BandView::setLine(const std::optional<MeasuredLine>& line)
{
    line_ = line;
    placeLine();
}

/// The line of before stays until the places of this one are found.
void BandView::placeLine()
{
    if (!line_ || line_->way_mm.empty() || !scan_ || !shown_ || line_->scan_id != scan_->record.id) {
        placed_line_.reset();
        drawLine();
        return;
    }
    worker_.post("line", [this, scan = scan_, band = shown_->band, line = *line_](Opened&) -> Worker::Work {
        PlacedLine placed{line, {band->placeOf(line.way_mm.front())}};
        if (line.way_mm.size() > 1)
            placed.ends.push_back(band->placeOf(line.way_mm.back()));
        return [this, scan, placed = std::move(placed)] {
            if (scan != scan_ || !line_)
                return;
            placed_line_ = placed;
            drawLine();
        };
    });
}

void BandView::drawLine()
{
    setCalliper(placed_line_ && shown_
                    ? inBand(placed_line_->line, placed_line_->ends, *shown_->band, shown_->picture.page)
                    : std::nullopt);
}

void BandView::clickedAt(Pixel at, Qt::KeyboardModifiers modifiers)
{
    if (!shown_)
        return;
    if (const auto point = shown_->picture.pointAt(*shown_->band, at))
        emit pointClicked(*point, modifiers);
}

void BandView::scroll(int steps, Qt::KeyboardModifiers modifiers)
{
    if (!shown_)
        return;
    if (modifiers & Qt::ControlModifier) {
        setWhole(steps < 0);
        return;
    }
    if (whole_)
        return;
    constexpr double kNotch = 0.125;  // of what is shown
    const BandPage& page = shown_->picture.page;
    const double by_mm = kNotch * steps * page.rowLength_mm() * (page.from_caecum ? -1 : 1);
    const double middle_mm = middle_mm_.value_or(look_.eye.station_mm);
    middle_mm_ = std::clamp(middle_mm + by_mm, shown_->band->firstStation_mm(), shown_->band->lastStation_mm());
    draw(true);
}

}  // namespace vicon::viewer
