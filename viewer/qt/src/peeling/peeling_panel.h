#pragma once

#include <QWidget>

#include "vicon/cases/density_sample.h"
#include "vicon/viewer/scene/snapshot.h"

class QCheckBox;
class QComboBox;
class QSlider;
class QLabel;

namespace vicon::viewer {

/// Translucency, the look below the wall: with which colours, from how deep on, everywhere or in a circle, in
/// place of the surface or over it.
class PeelingPanel : public QWidget {
    Q_OBJECT
public:
    explicit PeelingPanel(QWidget* parent = nullptr);
    bool on() const;
    bool circleOnly() const;
    bool overSurface() const;
    QString preset() const;  ///< empty: none
    double offset_mm() const;
    /// What is not known any more is none.
    void choose(const QString& preset, double offset_mm, bool circle_only, bool over_surface);
    /// Puts the choice into a request for an endoscopic picture.
    void fill(SnapshotRequest& request) const;
    /// In a corner of this view: the controls stay where they are.
    void showHistogramOn(QWidget* view);
    /// Of the biopsy that was taken last; one without voxels: none is shown.
    void showHistogram(const DensitySample& biopsy);

signals:
    void changed();

private:
    QComboBox* preset_;
    QSlider* offset_;
    QLabel* offset_text_;
    QCheckBox *circle_, *over_;
    QLabel* histogram_;
};

}  // namespace vicon::viewer
