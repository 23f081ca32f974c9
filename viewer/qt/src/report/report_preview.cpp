#include "report/report_preview.h"

#include <QDialogButtonBox>
#include <QPdfView>
#include <QVBoxLayout>
#include <algorithm>

namespace vicon::viewer {

ReportPreview::ReportPreview(const QByteArray& pdf, QWidget* parent) : QDialog(parent), bytes_(pdf), buffer_(&bytes_)
{
    constexpr int kLeastWidth_px = 820;  // less makes small letters of a page
    constexpr double kShape = 0.78;      // wider than a page is: its foot is scrolled to anyway
    constexpr int kMargin_px = 6;
    setObjectName("reportPreview");
    setAttribute(Qt::WA_DeleteOnClose);
    buffer_.open(QIODevice::ReadOnly);
    document_.load(&buffer_);
    const int pages = document_.pageCount();
    setWindowTitle(pages == 1 ? tr("Report: 1 page") : tr("Report: %1 pages").arg(pages));
    auto* view = new QPdfView(this);
    view->setObjectName("reportPages");
    view->setPageMode(QPdfView::MultiPage);
    view->setZoomMode(QPdfView::FitToWidth);
    view->setDocument(&document_);
    auto* all = new QVBoxLayout(this);
    all->setContentsMargins(0, 0, 0, 0);
    all->addWidget(view);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    buttons->setObjectName("reportPreviewButtons");
    buttons->setContentsMargins(0, 0, kMargin_px, kMargin_px);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    all->addWidget(buttons);
    view->setFocus();
    const int height = parent->height();
    resize(std::min(parent->width(), std::max(kLeastWidth_px, int(kShape * height))), height);
}

}  // namespace vicon::viewer
