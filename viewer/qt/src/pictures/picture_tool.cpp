#include "pictures/picture_tool.h"

#include <QApplication>
#include <QClipboard>

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
    if (const QImage& image = reading_.views().endoscopic()->image(); !image.isNull())
        reading_.session().savePicture(image);
}

void PictureTool::copy()
{
    const QImage& image = reading_.views().endoscopic()->image();
    if (image.isNull())
        return;
    QApplication::clipboard()->setImage(image);
    reading_.say(tr("Picture copied"));
}

}  // namespace vicon::viewer
