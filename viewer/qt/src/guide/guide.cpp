#include "guide/guide.h"

#include <QAbstractTextDocumentLayout>
#include <QDialog>
#include <QRegularExpression>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextBrowser>
#include <QVBoxLayout>

#include "guide/guide_text.h"

namespace vicon::viewer {
namespace {

constexpr int kGuideWidth_px = 640, kGuideHeight_px = 700, kGuideMargin_px = 12;

/// The title of a page of the guide that a link leads to; empty where it leads out of it.
QString titleBehind(const QString& link)
{
    for (const GuidePage& page : guidePages())
        if (link == page.file) {
            const QString first_line = QString::fromUtf8(page.text).section('\n', 0, 0);
            return first_line.section(' ', 1);
        }
    return {};
}

/// Links to pages that lie in the documentation alone are words.
QString withoutLinksOut(const QString& text)
{
    static const QRegularExpression kLink("\\[([^\\]]*)\\]\\(([^)]*)\\)");
    QString kept;
    int end = 0;
    for (auto links = kLink.globalMatch(text); links.hasNext();) {
        const auto link = links.next();
        kept += text.mid(end, link.capturedStart() - end);
        kept += titleBehind(link.captured(2)).isEmpty() ? link.captured(1) : link.captured();
        end = link.capturedEnd();
    }
    return kept + text.mid(end);
}

QDialog* openGuide(QWidget& window)
{
    auto* dialog = new QDialog(&window);
    dialog->setObjectName("guide");
    dialog->setWindowTitle(QObject::tr("Guide"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    auto* text = new QTextBrowser(dialog);
    text->setObjectName("guideText");
    text->setAccessibleName(QObject::tr("Guide"));
    text->setOpenLinks(false);
    text->setMarkdown(guideText());
    text->document()->setDocumentMargin(kGuideMargin_px);
    QObject::connect(text, &QTextBrowser::anchorClicked,
                     [&window](const QUrl& link) { showGuide(window, titleBehind(link.toString())); });
    auto* layout = new QVBoxLayout(dialog);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(text);
    dialog->resize(kGuideWidth_px, kGuideHeight_px);
    dialog->show();
    return dialog;
}

}  // namespace

QString guideText()
{
    static const QRegularExpression kPicture("!\\[[^\\]]*\\]\\([^)]*\\)");
    QStringList pages;
    for (const GuidePage& page : guidePages())
        pages << QString::fromUtf8(page.text).remove(kPicture);
    return withoutLinksOut(pages.join("\n\n"));
}

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
            break;
        }
    dialog->raise();
    dialog->activateWindow();
}

}  // namespace vicon::viewer
