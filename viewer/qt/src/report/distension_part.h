#pragma once

#include <QWidget>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "vicon/cases/report_content.h"

class QGridLayout;

namespace vicon::viewer {

class FormChoice;

/// How far open each part is in each scan: as measured, unless the reader says otherwise.
class DistensionPart : public QWidget {
    Q_OBJECT
public:
    explicit DistensionPart(QWidget* parent);

    void show(const ReadCase& read);

signals:
    void said(const std::function<void(vicon::Assessment&)>& change);

private:
    using Place = std::pair<std::string, ColonPart>;
    void build(const ReadCase& read);
    FormChoice* add(const Place& place, int row, int column, const QString& position);

    std::map<Place, FormChoice*> choices_;
    QGridLayout* grid_;
};

}  // namespace vicon::viewer
