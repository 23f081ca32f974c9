#include "reading/reading_views.h"

#include <QVBoxLayout>

#include "reading/second_window.h"
#include "widgets/kept_settings.h"
#include "widgets/panel_parts.h"

namespace vicon::viewer {
namespace {

constexpr int kPart_px = 150, kSideWidth_px = 430;  // of 96 to the inch, before the window is resized
constexpr int kMostSideWidth_px = kSideWidth_px * 5 / 4;
constexpr const char* kSlices = "window/slices";

SliceView* slice(SlicePlane plane, const char* name, const QString& title)
{
    auto* view = new SliceView(plane, title);
    view->setObjectName(name);
    return view;
}

}  // namespace

ReadingViews::ReadingViews(QWidget* parent) : QSplitter(Qt::Horizontal, parent)
{
    endoscopic_ = new PictureView(tr("Endoscopic view"));
    endoscopic_->setObjectName("endoscopic");
    endoscopic_->setMouseTracking(true);
    endoscopic_->setSteered();
    overview_ = new PictureView({});
    overview_->setObjectName("overview");
    overview_->setToolTip(tr("Click: go there. Double click: enlarge."));
    slices_ = {slice(SlicePlane::axial, "axial", tr("Axial slice")),
               slice(SlicePlane::coronal, "coronal", tr("Coronal slice")),
               slice(SlicePlane::sagittal, "sagittal", tr("Sagittal slice"))};
    slice_column_ = new QSplitter(Qt::Vertical);
    slice_column_->setObjectName("slices");
    side_ = new QWidget;
    side_->setMaximumWidth(kMostSideWidth_px);
    auto* column = new QVBoxLayout(side_);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(overview_);
    addWidget(endoscopic_);
    addWidget(slice_column_);
    addWidget(side_);
    setStretchFactor(0, 5);
    setStretchFactor(1, 3);
    setStretchFactor(2, 0);
    for (SliceView* view : slices_) {
        slice_column_->addWidget(view);
        connect(view, &PictureView::enlargeWanted, this, [this, view] { enlarge(view); });
    }
    connect(endoscopic_, &PictureView::enlargeWanted, this, [this] { enlarge(endoscopic_); });
    connect(overview_, &PictureView::enlargeWanted, this, [this] { enlarge(overview_); });
}

void ReadingViews::addBeside(QWidget* view)
{
    beside_ = view;
    insertWidget(1, view);
    setStretchFactor(1, 4);
    setSizes({5 * kPart_px, 4 * kPart_px, 3 * kPart_px, kSideWidth_px});
    view->hide();
}

void ReadingViews::addControls(QWidget* controls)
{
    controls_ = controls;
    side_->layout()->addWidget(controls);
}

std::vector<QWidget*> ReadingViews::inOrder() const
{
    std::vector<QWidget*> order{endoscopic_};
    if (beside_)
        for (QWidget* view : reachableIn(beside_))
            order.push_back(view);
    order.insert(order.end(), slices_.begin(), slices_.end());
    order.push_back(overview_);
    return order;
}

bool ReadingViews::roomBeside() const
{
    return !enlarged_ || (second_ && enlarged_ != endoscopic_);
}

void ReadingViews::enlarge(QWidget* view)
{
    enlarged_ = enlarged_ == view ? nullptr : view;
    // Of two windows, only the one that holds the view gives up its other views.
    const auto shown = [&](QWidget* widget) {
        const bool elsewhere = second_ && (widget == endoscopic_) != (enlarged_ == endoscopic_);
        return !enlarged_ || enlarged_ == widget || elsewhere;
    };
    const bool projection_alone = enlarged_ == overview_;
    overview_->setVisible(!second_ || !enlarged_ || enlarged_ == endoscopic_ || projection_alone);
    side_->setMaximumWidth(projection_alone && !second_ ? QWIDGETSIZE_MAX : kMostSideWidth_px);
    if (controls_)
        controls_->setVisible(!projection_alone || second_);
    bool any_slice = false;
    for (SliceView* slice : slices_) {
        slice->setVisible(shown(slice));
        any_slice = any_slice || shown(slice);
    }
    slice_column_->setVisible(any_slice);
    endoscopic_->setVisible(shown(endoscopic_));
    emit arranged();
    view->setFocus();  // else the first list would get the keys of a view that is hidden now
}

void ReadingViews::enlargeFocused()
{
    for (SliceView* slice : slices_)
        if (slice->hasFocus()) {
            enlarge(slice);
            return;
        }
    enlarge(enlarged_ ? enlarged_ : endoscopic_);
}

void ReadingViews::takeKeyboard()
{
    endoscopic_->setFocus(Qt::ShortcutFocusReason);
    if (second_)
        second_->setFocus(Qt::ShortcutFocusReason);
}

void ReadingViews::setPicking(bool on)
{
    for (PictureView* view :
         std::initializer_list<PictureView*>{endoscopic_, overview_, slices_[0], slices_[1], slices_[2]})
        view->setPicking(on);
    if (on && !qobject_cast<PictureView*>(window()->focusWidget()))
        endoscopic_->setFocus(Qt::ShortcutFocusReason);  // Return clicks in a picture
}

void ReadingViews::restoreSizes()
{
    restoreState(keptSetting(kColumnsKey).toByteArray());
    slice_column_->restoreState(keptSetting(kSlices).toByteArray());
    if (beside_)
        beside_->hide();  // shown when its scan is there
}

QVariantMap ReadingViews::sizes() const
{
    QVariantMap values = secondWindowSizes();
    values[kColumnsKey] = second_ ? columns_in_one_ : saveState();
    if (!second_)
        values[kSlices] = slice_column_->saveState();
    return values;
}

}  // namespace vicon::viewer
