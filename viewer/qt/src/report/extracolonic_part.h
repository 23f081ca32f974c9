#pragma once

#include <QWidget>
#include <functional>

#include "vicon/cases/report_content.h"

class QCheckBox;
class QLineEdit;
class QPushButton;
class QTableWidget;

namespace vicon::viewer {

class FormChoice;

/// What was found outside the colon: a list, and a line that adds to it.
class ExtracolonicPart : public QWidget {
    Q_OBJECT
public:
    explicit ExtracolonicPart(QWidget* parent);

    void show(const ReadCase& read);

signals:
    void said(const std::function<void(vicon::Assessment&)>& change);

private:
    void build();
    void add();
    void remove();

    QTableWidget* table_;
    FormChoice* category_;
    QLineEdit *organ_, *text_;
    QPushButton *add_, *remove_;
    QCheckBox* limited_;
};

}  // namespace vicon::viewer
