// Callipers over a picture: how they are drawn, and that their ends are dragged.
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "widgets/picture_view.h"

namespace vicon::viewer {
namespace {

constexpr double kGrip_px = 4, kGrasp_px = 10, kLabelOff_px = 10;  // of 96 to the inch
constexpr double kWidestLabel = 0.3;                               // of the view's width
constexpr double kLabelAbove = 0.2;          // of its height: a marker's name stands above its ring
const QColor kCalliperColor(255, 214, 102);  // as in the picture of the best plane

/// Of all that is drawn, in pixels of the picture.
double leftmostOf(const Calliper& calliper)
{
    double x = calliper.label_at.x();
    for (const QVector<QLineF>* lines : {&calliper.lines, &calliper.rim})
        for (const QLineF& line : *lines)
            x = std::min({x, line.x1(), line.x2()});
    for (const auto& grip : calliper.grips)
        if (grip)
            x = std::min(x, grip->x());
    return x;
}

}  // namespace

void PictureView::setCalliper(const std::optional<Calliper>& calliper)
{
    calliper_ = calliper;
    update();
}

void PictureView::setRing(const std::optional<PictureCircle>& ring)
{
    ring_ = ring;
    update();
}

void PictureView::drawRing(QPainter& painter) const
{
    if (!ring_)
        return;
    const double radius = ring_->radius_px / devicePixelRatioF();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    for (const auto& [color, width] : {std::pair(QColor(Qt::black), 3.0), std::pair(kCalliperColor, 1.2)}) {
        painter.setPen(QPen(color, width));
        painter.drawEllipse(toWidget(ring_->centre), radius, radius);
    }
}

std::optional<int> PictureView::gripAt(QPoint at) const
{
    if (!calliper_ || picking_ || circling_)
        return std::nullopt;
    std::optional<int> nearest;  // of a short line both may be in reach
    double least_px = kGrasp_px;
    for (int n = 0; n < 2; ++n)
        if (const auto& grip = calliper_->grips[std::size_t(n)]) {
            const QPointF off = toWidget({grip->x(), grip->y()}) - QPointF(at);
            if (const double far_px = std::hypot(off.x(), off.y()); far_px <= least_px) {
                least_px = far_px;
                nearest = n;
            }
        }
    return nearest;
}

void PictureView::dragGrip(QPoint to, GripDrag drag)
{
    const QPoint within(std::clamp(to.x(), 0, width() - 1), std::clamp(to.y(), 0, height() - 1));
    emit endDragged(*grip_, toPicture(within), drag);
}

bool PictureView::breakOffDrag()
{
    if (!grip_ || !dragging_)
        return false;
    dragGrip(pressed_, GripDrag::broken_off);
    grip_.reset();
    dragging_ = false;
    button_ = Qt::NoButton;
    return true;
}

void PictureView::hideEvent(QHideEvent*)
{
    breakOffDrag();
}

void PictureView::drawCalliper(QPainter& painter) const
{
    if (!calliper_)
        return;
    const double ratio = devicePixelRatioF();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.scale(1 / ratio, 1 / ratio);
    for (const auto& [color, width] : {std::pair(QColor(Qt::black), 4.0), std::pair(kCalliperColor, 1.6)}) {
        painter.setPen(QPen(color, width * ratio, calliper_->dashed ? Qt::DashLine : Qt::SolidLine, Qt::RoundCap));
        painter.setBrush(Qt::NoBrush);
        painter.drawLines(calliper_->lines);
        painter.setPen(QPen(color, width * ratio, Qt::SolidLine, Qt::RoundCap));
        painter.drawLines(calliper_->rim);
        for (const auto& grip : calliper_->grips)
            if (grip)
                painter.drawEllipse(*grip, kGrip_px * ratio, kGrip_px * ratio);
    }
    painter.resetTransform();
    drawCalliperText(painter);
}

void PictureView::drawCalliperText(QPainter& painter) const
{
    if (calliper_->text.isEmpty())
        return;
    // In a narrow view the length and what is said of it stand below each other, clear of the title.
    QString text = calliper_->text;
    if (painter.fontMetrics().horizontalAdvance(text) > kWidestLabel * width())
        text.replace(", ", ",\n");
    const QRectF words =
        QRectF(painter.fontMetrics().boundingRect(rect(), Qt::AlignLeft | Qt::AlignTop, text)).adjusted(-3, -1, 3, 1);
    const QPointF at = toWidget({calliper_->label_at.x(), calliper_->label_at.y()});
    const double on_the_right = at.x() + kLabelOff_px,
                 on_the_left = toWidget({leftmostOf(*calliper_), 0}).x() - kLabelOff_px - words.width();
    const bool fits = on_the_right + words.width() <= width() || on_the_left < 0;
    const double x = std::clamp(fits ? on_the_right : on_the_left, 0.0, std::max(0.0, width() - words.width()));
    const double y = std::clamp(at.y() - kLabelAbove * words.height(), 0.0, std::max(0.0, height() - words.height()));
    const QRectF box({x, y}, words.size());
    painter.fillRect(box, QColor(0, 0, 0, 190));
    painter.setPen(kCalliperColor);
    painter.drawText(box, Qt::AlignCenter, text);
}

}  // namespace vicon::viewer
