#pragma once

#include <QBuffer>
#include <QDialog>
#include <QPdfDocument>

namespace vicon::viewer {

/// The pages of a report, as they are printed.
class ReportPreview : public QDialog {
    Q_OBJECT
public:
    ReportPreview(const QByteArray& pdf, QWidget* parent);

private:
    QByteArray bytes_;
    QBuffer buffer_;
    QPdfDocument document_;
};

}  // namespace vicon::viewer
