#include "widgets/picture_view.h"

#include <QApplication>
#include <QFontInfo>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <cmath>

#include "vicon/viewer/scene/snapshot.h"

namespace vicon::viewer {
namespace {
constexpr int kLeastSide_px = 120;  // four views above one another are no higher than a screen of 768
}

PictureView::PictureView(const QString& name, QWidget* parent) : QWidget(parent)
{
    setAccessibleName(name);
    setMinimumSize(kLeastSide_px, kLeastSide_px);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setFocusPolicy(Qt::TabFocus);
    setAttribute(Qt::WA_OpaquePaintEvent);
}

void PictureView::showPicture(const Picture& picture)
{
    image_ = QImage(picture.rgb.data(), picture.width, picture.height, 3 * picture.width, QImage::Format_RGB888).copy();
    image_.setDevicePixelRatio(devicePixelRatioF());
    update();
}

void PictureView::setCircling(bool on)
{
    circling_ = on;
    dragging_ = dragging_ && (on || button_ != Qt::NoButton);
    forgetCross();
}

double PictureView::circleRadius() const
{
    const QPoint by = last_ - pressed_;
    return std::hypot(by.x(), by.y());
}

void PictureView::clearPicture(const QString& words)
{
    image_ = {};
    waiting_ = words;
    setNote({});
    setCalliper({});
    setRing({});
    setReadout({});
}

QSize PictureView::pictureSize() const
{
    const QSize wanted = size() * devicePixelRatioF();
    return wanted.boundedTo({SnapshotRequest::kMostSide, SnapshotRequest::kMostSide})
        .expandedTo({kLeastSide_px, kLeastSide_px});
}

Pixel PictureView::toPicture(QPoint at) const
{
    return {(at.x() + 0.5) * devicePixelRatioF(), (at.y() + 0.5) * devicePixelRatioF()};
}

double PictureView::textHeight_px() const
{
    return QFontInfo(font()).pixelSize() * devicePixelRatioF();
}

QPointF PictureView::toWidget(Pixel at) const
{
    return QPointF(at.x, at.y) / devicePixelRatioF();
}

void PictureView::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.fillRect(rect(), Qt::black);
    const QSizeF drawn = QSizeF(image_.size()) / image_.devicePixelRatioF();
    if (image_.isNull() && !waiting_.isEmpty()) {
        painter.setPen(Qt::lightGray);
        painter.drawText(rect().adjusted(0, height() / 4, 0, 0), Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap,
                         waiting_);
    }
    if (QSizeF(pictureSize()) / devicePixelRatioF() == drawn || image_.isNull()) {
        painter.drawImage(0, 0, image_);
        drawRing(painter);
        drawCalliper(painter);
        if (circling_ && dragging_) {
            painter.resetTransform();
            painter.setPen(QPen(Qt::white, 2));
            painter.drawEllipse(QPointF(pressed_), circleRadius(), circleRadius());
        }
        painter.resetTransform();
        drawReadout(painter);
        drawNote(painter);
        drawFocus(painter);
        return;
    }
    // The view has another size by now, and its picture is still to come.
    const QSizeF fitting = drawn.scaled(size(), Qt::KeepAspectRatio);
    painter.drawImage(QRectF({(width() - fitting.width()) / 2, (height() - fitting.height()) / 2}, fitting), image_);
    drawNote(painter);
}

void PictureView::resizeEvent(QResizeEvent*)
{
    emit resized();
}

void PictureView::mousePressEvent(QMouseEvent* event)
{
    reached_ = false;
    update();
    if (breakOffDrag())
        return;  // by another button
    emit pressed();
    pressed_ = last_ = event->pos();
    button_ = event->button();
    dragging_ = false;
    grip_ = button_ == Qt::LeftButton ? gripAt(pressed_) : std::nullopt;
}

void PictureView::mouseMoveEvent(QMouseEvent* event)
{
    if (button_ == Qt::NoButton) {
        if (steered_ || picking_ || circling_) {  // else Return clicks where the view says, wherever the mouse is
            if (!mouse_moved_last_)
                update();
            cross_ = event->pos();
            mouse_moved_last_ = true;
        }
        emit hovered(toPicture(event->pos()));
        return;
    }
    dragging_ = dragging_ || (event->pos() - pressed_).manhattanLength() >= QApplication::startDragDistance();
    if (!dragging_)
        return;
    if (grip_) {
        dragGrip(event->pos(), GripDrag::held);
        return;
    }
    if (circling_) {
        last_ = event->pos();
        update();
        return;
    }
    emit dragged(QPointF(event->pos() - last_) * devicePixelRatioF(), button_);
    last_ = event->pos();
}

void PictureView::mouseReleaseEvent(QMouseEvent* event)
{
    const bool was_click = !dragging_ && button_ == event->button();
    if (dragging_ && grip_)
        dragGrip(event->pos(), GripDrag::released);
    else if (dragging_ && circling_)
        emit circled(toPicture(pressed_), circleRadius() * devicePixelRatioF());
    else if (dragging_)
        emit dragEnded();
    button_ = Qt::NoButton;
    dragging_ = false;
    grip_.reset();
    if (was_click && event->button() == Qt::RightButton)
        emit menuWanted(event->globalPos());
    else if (was_click && event->button() == Qt::LeftButton && !image_.isNull())
        emit clicked(toPicture(event->pos()), event->modifiers());
}

void PictureView::contextMenuEvent(QContextMenuEvent* event)
{
    if (event->reason() == QContextMenuEvent::Keyboard)  // the mouse's waits for the button: its drag is no click
        emit menuWanted(mapToGlobal(rect().center()));
}

void PictureView::mouseDoubleClickEvent(QMouseEvent*)
{
    if (!picking_ && !circling_)  // the view stays as it is between the clicks of a measurement
        emit enlargeWanted();
}

void PictureView::wheelEvent(QWheelEvent* event)
{
    constexpr int kStep = 120;  // Qt: one notch of a usual wheel
    wheel_ += event->angleDelta().y();
    if (const int steps = wheel_ / kStep) {
        wheel_ -= steps * kStep;
        emit turned(steps, event->modifiers());
    }
}

}  // namespace vicon::viewer
