#pragma once

#include <QWidget>

#include "vicon/core/colon_parts.h"
#include "vicon/viewer/model/missed_regions.h"

class QCheckBox;
class QDoubleSpinBox;
class QLabel;
class QPixmap;
class QPushButton;
class QTableWidget;

namespace vicon::viewer {

/// How much of the wall was reviewed, and the regions that were missed, with their pictures.
class CoveragePanel : public QWidget {
    Q_OBJECT
public:
    explicit CoveragePanel(QWidget* parent = nullptr);

    /// What the column of distances means; empty: there are none.
    void setStationTip(const QString& tip);
    void setSeen(double fraction);
    /// Anew, without pictures.
    void show(const MissedRegions& missed, const ColonPartRanges& parts);
    /// The same regions; which are done, and which is looked at.
    void mark(const MissedRegions& missed);
    void setPicture(int region, const QPixmap& picture);
    /// For those of a region, in device pixels.
    static QSize pictureSize();
    bool paints() const;
    void setPaints(bool on);
    double least_mm2() const;
    void setLeast(double least_mm2);

signals:
    void paintWanted(bool on);
    void listWanted();
    void nextWanted();
    void forgetWanted();
    void flyWanted(int region);

private:
    void layOut();
    void connectAll();

    QLabel* text_;
    QCheckBox* paint_;
    QDoubleSpinBox* least_;
    QPushButton *next_, *list_, *forget_;
    QTableWidget* table_;
};

}  // namespace vicon::viewer
