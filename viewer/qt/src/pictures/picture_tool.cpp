#include "pictures/picture_tool.h"

#include <QApplication>
#include <QClipboard>
#include <QFontInfo>
#include <QPainter>

#include "reading/reading.h"
#include "window/reading_layout.h"

namespace vicon::viewer {

void PictureTool::addTo(ReadingLayout& layout)
{
    layout.addAction(ReadingMenu::a_case, tr("Save picture to the case"), QKeySequence("Ctrl+S"), [this] { save(); });
    layout.addAction(ReadingMenu::a_case, tr("Copy picture"), QKeySequence("Ctrl+C"), [this] { copy(); });
}

void PictureTool::save()
{
    if (const QImage image = named(); !image.isNull())
        reading_.session().savePicture(image);
}

void PictureTool::copy()
{
    const QImage image = named();
    if (image.isNull())
        return;
    QApplication::clipboard()->setImage(image);
    reading_.say(tr("Picture copied"));
}

/// The view that is looked at, below a line that says whose it is: it leaves the window, whose banner said so.
QImage PictureTool::named() const
{
    PictureView* view = reading_.views().lookedAt();
    const OpenScan* scan = reading_.views().isBeside(view) ? reading_.session().beside() : reading_.scan();
    if (view->image().isNull() || !scan)
        return {};
    const QImage image = view->seen();
    const double ratio = image.devicePixelRatio();
    constexpr int kMargin_px = 4;
    QFont letters = QApplication::font();
    const int line_px = int((QFontMetrics(letters).height() + 2 * kMargin_px) * ratio);
    QImage whole(image.width(), image.height() + line_px, QImage::Format_RGB888);
    whole.fill(Qt::black);
    QPainter painter(&whole);
    QImage plain = image;
    plain.setDevicePixelRatio(1);
    painter.drawImage(0, line_px, plain);
    letters.setPixelSize(int(QFontInfo(letters).pixelSize() * ratio));
    painter.setFont(letters);
    painter.setPen(Qt::white);
    painter.drawText(QRect(0, 0, whole.width(), line_px).adjusted(kMargin_px, 0, 0, 0), Qt::AlignVCenter,
                     painter.fontMetrics().elidedText(scan->inWords(), Qt::ElideRight, whole.width() - 2 * kMargin_px));
    return whole;
}

}  // namespace vicon::viewer
