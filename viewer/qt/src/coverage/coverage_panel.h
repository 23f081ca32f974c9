#pragma once

#include <QWidget>
#include <vector>

#include "vicon/core/colon_parts.h"
#include "vicon/viewer/model/unseen.h"

class QCheckBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QTableWidget;

namespace vicon::viewer {

/// How much of the wall was seen, and what was not.
class CoveragePanel : public QWidget {
    Q_OBJECT
public:
    explicit CoveragePanel(QWidget* parent = nullptr);

    /// What the column of distances means.
    void setStationTip(const QString& tip);
    void setSeen(double fraction);
    /// In order of station, from the rectum.
    void show(std::vector<UnseenPatch> patches, const ColonPartRanges& parts);
    bool paints() const;
    void setPaints(bool on);
    double least_mm2() const;

signals:
    void paintWanted(bool on);
    void listWanted();
    void forgetWanted();
    void flyWanted(const vicon::viewer::UnseenPatch& patch);

private:
    std::vector<UnseenPatch> patches_;
    QLabel* text_;
    QCheckBox* paint_;
    QDoubleSpinBox* least_;
    QPushButton *list_, *forget_;
    QTableWidget* table_;
};

}  // namespace vicon::viewer
