// What a click in a view means.
#include <utility>

#include "reading/reading.h"

namespace vicon::viewer {

void Reading::begin(const ToolInUse& tool, const QString& prompt)
{
    interaction_.begin(tool);
    for (ReadingTool* each : tools_)
        each->nextClickChanged();
    toolChanged();
    say(prompt);
}

void Reading::toolChanged()
{
    const bool circling = interaction_.inUse<CircleFinding>();
    views_.endoscopic()->setCircling(circling);
    for (SliceView* slice : views_.slices())
        slice->setCircling(circling);
    views_.setPicking(interaction_.awaitsClick());
    emit awaitingClick(interaction_.awaitsClick());
}

bool Reading::click(const ClickedPoint& point)
{
    PickedPoint picked;
    picked.at_mm = point.at_mm;
    picked.scan_id = point.scan.record.id;
    picked.on_wall = point.on_wall;
    picked.wants_marker = point.modifiers & Qt::ShiftModifier;
    picked.voxel_mm = point.scan.voxel_mm();
    const ClickMeaning meaning = interaction_.click(picked);
    if (std::holds_alternative<ShowPoint>(meaning))
        return false;
    for (ReadingTool* tool : tools_)
        if (tool->act(meaning, point))
            break;
    return true;
}

ClickedPoint Reading::wallPoint(Point3 point, Qt::KeyboardModifiers modifiers) const
{
    const OpenScan& open = *scan();
    const ViewPose view = poseForPoint(open.files.skeleton(), open.files.frames(), open.lumen, point);
    return {open, SnapshotResult{view.pose, view.station_mm, view.clearance_mm, view.sees_target}, point, modifiers,
            true};
}

void Reading::takeBackClicksIn(const PictureView* view)
{
    connect(view, &PictureView::pressed, this, &Reading::rememberPlace);
    connect(view, &PictureView::enlargeWanted, this, &Reading::takeBackClick);
}

/// At every press of the mouse, whatever comes of it: what was before an earlier click is long over.
void Reading::rememberPlace()
{
    if (navigator())
        before_click_ = PlaceBefore{navigator()->place(), looked_at_mm_};
}

void Reading::clickedEndoscopic(Pixel at, Qt::KeyboardModifiers modifiers)
{
    if (!navigator())
        return;
    if (!shown_.isOf(sharedScan())) {
        say(tr("The picture of this scan is still to come; click again when it is there."));
        return;
    }
    const auto point = shown_.wallAt(at);
    if (!point) {
        if (shown_.acquired)
            say(tr("As acquired, no wall is seen there; Ctrl+K shows it without fluid and stool."));
        return;
    }
    const bool measuring = interaction_.inUse<Measure>();
    click({*scan(), shown_.place, *point, modifiers, !shown_.acquired});
    if (measuring)
        return;  // no view moves while a length is measured in it
    looked_at_mm_ = point;
    showPlace();
}

void Reading::clickedSlice(SliceView& slice, Point3 point, Qt::KeyboardModifiers modifiers)
{
    if (!navigator())
        return;
    const bool measuring = interaction_.inUse<Measure>();
    if (!click({*scan(), {}, point, modifiers, false})) {
        goTo(point);
        if (modifiers & Qt::ControlModifier)
            slice.toAcquiredAndBack();
    } else if (!measuring) {
        looked_at_mm_ = point;
        showPlace();
    }
}

// The first click of a double click has shown a place by then; what is enlarged is what was there before.
void Reading::takeBackClick()
{
    const auto before = std::exchange(before_click_, {});
    if (!before || !navigator())
        return;
    navigator()->goBackTo(before->eye);
    looked_at_mm_ = before->looked_at_mm;
    moved(true);
}

void Reading::giveUp()
{
    views_.takeKeyboard();
    session_.giveUpMeasuring();
    endTool();
    for (ReadingTool* tool : tools_)
        tool->escape();
    warn({});
}

}  // namespace vicon::viewer
