#pragma once

#include <QObject>

class QWidget;

namespace vicon::viewer {

/// Whose a key is, in a window where plain letters are commands. A control that got the keyboard by Tab keeps the keys
/// that it understands; a click on a control leaves the keyboard where it is, one on a picture and a number that was
/// entered give it back to the picture.
class ControlKeys : public QObject {
    Q_OBJECT
public:
    /// Of all controls that the window has by now, but for those of a form: its keys are its own. @param picture has
    /// the keyboard unless it is given to another
    ControlKeys(QWidget* window, QWidget* picture);
    /// Another picture has it from now on.
    void setPicture(QWidget* picture) { picture_ = picture; }

protected:
    bool eventFilter(QObject* control, QEvent* event) override;

private:
    QWidget* picture_;
};

}  // namespace vicon::viewer
