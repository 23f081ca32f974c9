// What a picture says over itself.
#include <QPainter>

#include "widgets/picture_view.h"

namespace vicon::viewer {

void PictureView::setNote(const QString& note)
{
    if (note == note_)
        return;
    note_ = note;
    update();
}

void PictureView::noteWhereElsewhere(const Point3& shown_mm, const Point3& wanted_mm)
{
    setNote(distance(shown_mm, wanted_mm) > kElsewhere_mm ? notThisPlaceYet() : QString());
}

void PictureView::drawNote(QPainter& painter) const
{
    if (note_.isEmpty())
        return;
    constexpr int kAbove_px = 40, kSpare_px = 4;
    QRect words = painter.fontMetrics().boundingRect(note_).adjusted(-kSpare_px, -kSpare_px, kSpare_px, kSpare_px);
    words.moveCenter({width() / 2, height() - kAbove_px});
    painter.fillRect(words, QColor(0, 0, 0, 190));
    painter.setPen(Qt::white);
    painter.drawText(words, Qt::AlignCenter, note_);
}

void PictureView::setReadout(const QString& text)
{
    if (text == readout_)
        return;
    readout_ = text;
    update();
}

/// Above the letter of the lower edge where it would reach to that.
void PictureView::drawReadout(QPainter& painter) const
{
    if (readout_.isEmpty() || !note_.isEmpty())
        return;
    constexpr int kEdge_px = 3, kSpare_px = 2;
    const int line_px = painter.fontMetrics().height();
    QRect words = painter.fontMetrics().boundingRect(readout_).adjusted(-kSpare_px, 0, kSpare_px, 0);
    words.moveBottomLeft({kEdge_px, height() - kEdge_px});
    if (words.right() > width() / 2 - line_px)
        words.translate(0, -line_px - line_px / 2);
    painter.fillRect(words, QColor(0, 0, 0, 150));
    painter.setPen(QColor(235, 235, 235));
    painter.drawText(words, Qt::AlignCenter, readout_);
}

}  // namespace vicon::viewer
