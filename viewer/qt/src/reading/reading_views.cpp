#include "reading/reading_views.h"

#include <QApplication>
#include <QVBoxLayout>
#include <algorithm>

#include "reading/second_window.h"
#include "widgets/kept_settings.h"
#include "widgets/panel_parts.h"

namespace vicon::viewer {
namespace {

constexpr int kPart_px = 150, kSideWidth_px = 430;  // of 96 to the inch, before the window is resized
constexpr int kLeastOverview_px = 200;              // less shows no colon between its words
constexpr int kMostSideWidth_px = kSideWidth_px * 5 / 4;
constexpr int kLeastBesideForm_px = 1000;  // of all columns; less leaves pictures that nobody can read

SliceView* slice(SlicePlane plane, const char* name, const QString& title)
{
    auto* view = new SliceView(plane, title);
    view->setObjectName(name);
    return view;
}

QSplitter* column(const char* name)
{
    auto* made = new QSplitter(Qt::Vertical);
    made->setObjectName(name);
    return made;
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
    overview_->setMinimumSize(kLeastOverview_px, kLeastOverview_px);
    overview_->setToolTip(tr("Click: go there. Double click: enlarge."));
    slices_ = {slice(SlicePlane::axial, "axial", tr("Axial slice")),
               slice(SlicePlane::coronal, "coronal", tr("Coronal slice")),
               slice(SlicePlane::sagittal, "sagittal", tr("Sagittal slice")),
               slice(SlicePlane::across, "across", tr("Slice across the lumen"))};
    first_column_ = column("firstColumn");
    second_column_ = column("slices");
    side_ = new QWidget;
    side_->setMaximumWidth(kMostSideWidth_px);
    auto* side = new QVBoxLayout(side_);
    side->setContentsMargins(0, 0, 0, 0);
    side->addWidget(overview_);
    addWidget(first_column_);
    addWidget(second_column_);
    addWidget(side_);
    fillColumns();
    setStretchFactor(0, 5);
    setStretchFactor(1, 3);
    setStretchFactor(2, 0);
    for (SliceView* view : slices_)
        connect(view, &PictureView::enlargeWanted, this, [this, view] { enlarge(view); });
    connect(endoscopic_, &PictureView::enlargeWanted, this, [this] { enlarge(endoscopic_); });
    connect(overview_, &PictureView::enlargeWanted, this, [this] { enlarge(overview_); });
}

void ReadingViews::addBeside(QSplitter* view)
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
    std::vector<QWidget*> order = firstColumn();
    if (beside_)
        for (QWidget* view : reachableIn(beside_))
            order.push_back(view);
    for (QWidget* view : secondColumn())
        order.push_back(view);
    order.push_back(overview_);
    return order;
}

bool ReadingViews::inSecondWindow(const QWidget* view) const
{
    return second_ && (view == overview_ || view->parentWidget() == second_column_);
}

bool ReadingViews::roomBeside() const
{
    return !enlarged_ || inSecondWindow(enlarged_);
}

void ReadingViews::enlarge(QWidget* view)
{
    enlarged_ = enlarged_ == view ? nullptr : view;
    showViews();
    emit arranged();
    view->setFocus();  // else the first list would get the keys of a view that is hidden now
}

// Of two windows, only the one that holds the enlarged view gives up its other views.
void ReadingViews::showViews()
{
    const bool projection_alone = enlarged_ == overview_;
    overview_->setVisible(!second_ || !enlarged_ || !inSecondWindow(enlarged_) || projection_alone);
    side_->setMaximumWidth(projection_alone && !second_ ? QWIDGETSIZE_MAX : kMostSideWidth_px);
    if (controls_)
        controls_->setVisible(!projection_alone || second_);
    const bool for_second_window_alone = layout_ == ViewLayout::both_scans && !second_;
    const auto show = [&](QSplitter* column, const std::vector<QWidget*>& views, bool wanted) {
        bool any = false;
        for (QWidget* view : views) {
            const bool shown =
                wanted && (!enlarged_ || enlarged_ == view || inSecondWindow(view) != inSecondWindow(enlarged_));
            view->setVisible(shown);
            any = any || shown;
        }
        column->setVisible(any);
    };
    show(first_column_, firstColumn(), true);
    show(second_column_, secondColumn(), !for_second_window_alone);
    showSide();
}

void ReadingViews::showSide()
{
    const bool shown = !form_beside_ || second_ || enlarged_ == overview_ || width() >= kLeastBesideForm_px;
    if (shown == !side_->isHidden())
        return;
    if (!shown)
        columns_before_form_ = saveState();
    side_->setVisible(shown);
    if (shown)
        restoreState(columns_before_form_);
    emit arranged();
}

void ReadingViews::setFormBeside(bool on)
{
    form_beside_ = on;
    showSide();
}

void ReadingViews::resizeEvent(QResizeEvent* event)
{
    QSplitter::resizeEvent(event);
    showSide();
}

void ReadingViews::enlargeFocused()
{
    for (SliceView* slice : slices_)
        if (slice->hasFocus()) {
            enlarge(slice);
            return;
        }
    enlarge(enlarged_ ? enlarged_ : first());
}

PictureView* ReadingViews::lookedAt() const
{
    auto* reached = qobject_cast<PictureView*>(QApplication::focusWidget());
    if (reached && reached->isVisible())
        return reached;
    if (auto* enlarged = qobject_cast<PictureView*>(enlarged_); enlarged && enlarged->isVisible())
        return enlarged;
    for (QWidget* view : inOrder())
        if (auto* picture = qobject_cast<PictureView*>(view); picture && picture->isVisible())
            return picture;
    return first();
}

void ReadingViews::takeKeyboard()
{
    (enlarged_ ? enlarged_ : first())->setFocus(Qt::ShortcutFocusReason);
    if (second_)
        second_->setFocus(Qt::ShortcutFocusReason);
}

void ReadingViews::setPicking(bool on)
{
    for (PictureView* view : {endoscopic_, overview_})
        view->setPicking(on);
    for (SliceView* slice : slices_)
        slice->setPicking(on);
    if (on && !qobject_cast<PictureView*>(window()->focusWidget()))
        first()->setFocus(Qt::ShortcutFocusReason);  // Return clicks in a picture
}

}  // namespace vicon::viewer
