// What the views are asked to draw, and what they say until it is there.
#include "reading/reading.h"

namespace vicon::viewer {

SnapshotRequest Reading::snapshotOf(const OpenScan& scan, const QSize& size) const
{
    SnapshotRequest request;
    request.width = size.width();
    request.height = size.height();
    request.pixel_ratio = views_.devicePixelRatioF();
    request.text_px = views_.endoscopic()->textHeight_px();
    request.caption = scan.caption;
    request.markers = session_.markersOf(scan.record.id);
    for (const ReadingTool* tool : tools_)
        tool->annotate(request, scan);
    return request;
}

EndoscopicRequest Reading::requestFor(const OpenScan& scan, const NavigationState& at, const QSize& size,
                                      bool still) const
{
    EndoscopicRequest request;
    request.snapshot = snapshotOf(scan, size);
    request.place = {at.pose, at.station_mm, at.clearance_mm, true};
    request.still = still;
    for (const ReadingTool* tool : tools_)
        tool->style(request);
    return request;
}

void Reading::drawEndoscopic(bool still)
{
    if (!scan())
        return;
    const PictureView& view = *views_.endoscopic();
    EndoscopicRequest request = requestFor(*scan(), navigator()->state(), view.pictureSize(), still);
    request.count_seen = view.isVisible();
    for (const ReadingTool* tool : tools_)
        tool->complete(request);
    asked_peel_ = ChosenPeel::of(request.snapshot.peel);
    asked_eye_mm_ = request.place.pose.eye_mm;
    sayWhatIsDrawn();
    drawing_.drawEndoscopic(sharedScan(), request);
}

// Translucency takes its time, and so does a far jump; until the picture is there it says so.
void Reading::sayWhatIsDrawn()
{
    const bool elsewhere =
        shown_.isOf(sharedScan()) && distance(shown_.place.pose.eye_mm, asked_eye_mm_) > PictureView::kElsewhere_mm;
    const bool agrees = shown_.peel == asked_peel_;
    views_.endoscopic()->setNote(elsewhere                    ? PictureView::notThisPlaceYet()
                                 : agrees                     ? QString()
                                 : asked_peel_.preset.empty() ? tr("the wall is being drawn ...")
                                                              : tr("translucency: being drawn ..."));
}

void Reading::setOverviewTurned(bool on)
{
    if (on == overview_turned_)
        return;
    overview_turned_ = on;
    shown_overview_.reset();
    drawOverview(true);
}

void Reading::sayWhereOverviewIs()
{
    PictureView& view = *views_.overview();
    if (shown_overview_)
        view.noteWhereElsewhere(shown_overview_->eye_mm, place().pose.eye_mm);
    else if (!view.image().isNull())
        view.setNote(tr("being drawn ..."));  // it was turned
}

void Reading::drawOverview(bool still)
{
    if (!scan() || overview_turned_)
        return;
    sayWhereOverviewIs();
    drawing_.drawOverview(sharedScan(), snapshotOf(*scan(), views_.overview()->pictureSize()), place(), still);
}

void Reading::showPlace()
{
    const NavigationState state = navigator()->state();
    for (ReadingTool* tool : tools_)
        tool->placeShown();
    const SnapshotRequest shown = snapshotOf(*scan(), {});
    const auto follows = looked_at_mm_ ? SliceView::Move::as_needed : SliceView::Move::with_the_point;
    const Point3 point = looked_at_mm_.value_or(placeInSlices(*scan(), state));
    for (SliceView* slice : views_.slices())
        slice->look(sharedScan(), point, state.pose, shown.markers, shown.priors, follows);
}

}  // namespace vicon::viewer
