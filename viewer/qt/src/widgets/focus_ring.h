#pragma once

#include <QFocusFrame>
#include <QPointer>

namespace vicon::viewer {

/// A bright frame around the control that has the keyboard, in all windows of the application: that of the dark theme
/// is hardly seen. A PictureView draws its own.
class FocusRing : public QObject {
    Q_OBJECT
public:
    explicit FocusRing(QObject* parent);
    ~FocusRing() override;

private:
    void follow(QWidget* control);

    QPointer<QFocusFrame> frame_;  // goes with the window that it is in
};

}  // namespace vicon::viewer
