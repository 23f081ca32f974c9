#include "report/report_preview.h"

#include <QPdfView>
#include <QVBoxLayout>

namespace vicon::viewer {

ReportPreview::ReportPreview(const QByteArray& pdf, QWidget* parent) : QDialog(parent), bytes_(pdf), buffer_(&bytes_)
{
    constexpr int kWidth_px = 820, kHeight_px = 1000;
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
    resize(kWidth_px, kHeight_px);
}

}  // namespace vicon::viewer
