// What a picture does without a mouse: a cross that the arrow keys move, and Return for the click.
#include <QKeyEvent>
#include <QPainter>
#include <algorithm>

#include "widgets/picture_view.h"
#include "widgets/theme.h"

namespace vicon::viewer {
namespace {

constexpr int kStep_px = 8, kFineStep_px = 1, kPan_px = 24;
constexpr int kCrossArm_px = 9, kCrossGap_px = 3;

std::optional<QPoint> arrowOf(const QKeyEvent& key)
{
    switch (key.key()) {
        case Qt::Key_Left:
            return QPoint(-1, 0);
        case Qt::Key_Right:
            return QPoint(1, 0);
        case Qt::Key_Up:
            return QPoint(0, -1);
        case Qt::Key_Down:
            return QPoint(0, 1);
        default:
            return std::nullopt;
    }
}

}  // namespace

void PictureView::setPicking(bool on)
{
    picking_ = on;
    setCursor(on ? Qt::CrossCursor : Qt::ArrowCursor);
    forgetCross();
}

void PictureView::forgetCross()
{
    cross_.reset();
    mouse_moved_last_ = false;
    update();
}

bool PictureView::takesArrows() const
{
    return picking_ || circling_ || (reached_ && !steered_);
}

void PictureView::moveCross(QPoint by)
{
    const QPoint to = cross_.value_or(home()) + by;
    cross_ = QPoint(std::clamp(to.x(), 0, width() - 1), std::clamp(to.y(), 0, height() - 1));
    mouse_moved_last_ = false;
    if (circling_ && dragging_)
        last_ = *cross_;
    emit hovered(toPicture(*cross_));
    update();
}

void PictureView::clickAtCross(Qt::KeyboardModifiers modifiers)
{
    const QPoint at = cross_.value_or(home());
    if (!circling_) {
        emit clicked(toPicture(at), modifiers & Qt::ShiftModifier);
    } else if (!dragging_) {
        dragging_ = true;
        pressed_ = last_ = at;
    } else {
        dragging_ = false;
        emit circled(toPicture(pressed_), circleRadius() * devicePixelRatioF());
    }
}

bool PictureView::actedOn(const QKeyEvent& key)
{
    const bool control = key.modifiers() & Qt::ControlModifier, shift = key.modifiers() & Qt::ShiftModifier;
    const auto arrow = arrowOf(key);
    if (arrow && control && shift && reached_ && !steered_)
        emit dragged(QPointF(*arrow * kPan_px) * devicePixelRatioF(), Qt::LeftButton);
    else if (arrow && control && reached_ && !steered_)
        emit dragged(QPointF(*arrow * -kPan_px) * devicePixelRatioF(), Qt::RightButton);
    else if (arrow && !control && takesArrows())
        moveCross(*arrow * (shift ? kFineStep_px : kStep_px));
    else if ((key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter) && !image_.isNull())
        clickAtCross(key.modifiers());
    else if (key.key() == Qt::Key_PageUp || key.key() == Qt::Key_PageDown)
        emit turned(key.key() == Qt::Key_PageUp ? 1 : -1, key.modifiers());
    else
        return false;
    return true;
}

void PictureView::keyPressEvent(QKeyEvent* event)
{
    event->setAccepted(actedOn(*event));
}

void PictureView::focusInEvent(QFocusEvent* event)
{
    const Qt::FocusReason why = event->reason();
    if (why != Qt::ActiveWindowFocusReason && why != Qt::PopupFocusReason && why != Qt::MenuBarFocusReason)
        reached_ = why == Qt::TabFocusReason || why == Qt::BacktabFocusReason || why == Qt::ShortcutFocusReason;
    forgetCross();
}

void PictureView::focusOutEvent(QFocusEvent*)
{
    update();
}

void PictureView::leaveEvent(QEvent*)
{
    if (mouse_moved_last_)
        forgetCross();
}

QImage PictureView::seen()
{
    copied_ = true;
    QImage seen = grab().toImage();
    copied_ = false;
    return seen;
}

void PictureView::drawFocus(QPainter& painter) const
{
    if (!hasFocus() || copied_)
        return;
    painter.setRenderHint(QPainter::Antialiasing, false);
    constexpr int kRing_px = 2;
    if (reached_) {
        painter.setPen(QPen(focusColor(), kRing_px, Qt::SolidLine, Qt::SquareCap, Qt::MiterJoin));
        painter.drawRect(rect().adjusted(kRing_px / 2, kRing_px / 2, -kRing_px / 2, -kRing_px / 2));
    }
    if (!takesArrows() || mouse_moved_last_)
        return;
    const QPoint at = cross_.value_or(home());
    for (const auto& [color, width] : {std::pair(QColor(Qt::black), 4), std::pair(focusColor(), 2)}) {
        painter.setPen(QPen(color, width));
        for (const QPoint side : {QPoint(1, 0), QPoint(-1, 0), QPoint(0, 1), QPoint(0, -1)})
            painter.drawLine(at + side * kCrossGap_px, at + side * kCrossArm_px);
    }
}

}  // namespace vicon::viewer
