#include "guide/guide.h"

#include <QAbstractTextDocumentLayout>
#include <QDialog>
#include <QRegularExpression>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextBrowser>
#include <QVBoxLayout>

namespace vicon::viewer {
namespace {

constexpr int kGuideWidth_px = 620, kGuideHeight_px = 700;

QDialog* openGuide(QWidget& window)
{
    auto* dialog = new QDialog(&window);
    dialog->setObjectName("guide");
    dialog->setWindowTitle(QObject::tr("Guide"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    auto* text = new QTextBrowser(dialog);
    text->setObjectName("guideText");
    text->setAccessibleName(QObject::tr("Guide"));
    text->setOpenLinks(false);  // to other pages, which lie in the documentation
    text->setMarkdown(QString::fromUtf8(kGuideText).remove(QRegularExpression("!\\[[^\\]]*\\]\\([^)]*\\)")));
    auto* layout = new QVBoxLayout(dialog);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(text);
    dialog->resize(kGuideWidth_px, kGuideHeight_px);
    dialog->show();
    return dialog;
}

}  // namespace

void showGuide(QWidget& window, const QString& heading)
{
    auto* dialog = window.findChild<QDialog*>("guide");
    if (!dialog)
        dialog = openGuide(window);
    auto* text = dialog->findChild<QTextBrowser*>("guideText");
    for (QTextBlock block = text->document()->begin(); block.isValid(); block = block.next())
        if (block.blockFormat().headingLevel() > 0 && block.text() == heading) {
            text->setTextCursor(QTextCursor(block));
            text->verticalScrollBar()->setValue(
                int(text->document()->documentLayout()->blockBoundingRect(block).top()));
        }
    dialog->raise();
    dialog->activateWindow();
}

}  // namespace vicon::viewer
