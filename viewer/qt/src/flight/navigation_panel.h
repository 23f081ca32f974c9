#pragma once

#include <QWidget>

#include "vicon/viewer/model/navigator.h"
#include "vicon/viewer/model/organ_words.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QSlider;

namespace vicon::viewer {

/// The controls of flight.
class NavigationPanel : public QWidget {
    Q_OBJECT
public:
    explicit NavigationPanel(QWidget* parent = nullptr);
    void show(const Navigator& navigator, double length_mm, const OrganWords& words);
    /// The keyboard to the field of the distance.
    void askStation();
    /// What was typed there and not used.
    void forgetStation();
    void setAngle(double angle_deg);

signals:
    void modeWanted(vicon::viewer::NavigationMode mode);
    void flyWanted(int direction);
    void turnAboutWanted();
    void lookBackWanted(bool on);
    void speedWanted(double mm_s);
    void stepWanted(double mm);
    void jumpWanted(double station_mm);
    void angleWanted(double angle_deg);

private:
    void buildButtons();
    void buildSliders();
    void buildPlace();
    void layOut();
    void connectAll();
    void jump();

    QComboBox* mode_;
    QPushButton *back_, *stop_, *forward_, *about_, *look_back_, *step_back_, *step_on_, *go_;
    QSlider *speed_, *angle_;
    QLabel* angle_text_;
    QDoubleSpinBox* station_;
    double shown_station_mm_ = 0;  // what show() last put into the field
    QLabel *speed_text_, *where_;
};

}  // namespace vicon::viewer
