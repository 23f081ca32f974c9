#pragma once

#include <QCloseEvent>
#include <QKeyEvent>
#include <QSplitter>

namespace vicon::viewer {

/// A window beside the main one, for a second screen. It has the main one's keys.
class SecondWindow : public QSplitter {
    Q_OBJECT
public:
    explicit SecondWindow(QWidget* main) : QSplitter(Qt::Vertical, main) { setWindowFlag(Qt::Window); }

signals:
    void closed();
    void keyPressed(QKeyEvent* event);
    void keyReleased(QKeyEvent* event);
    void left();  ///< keys are let go elsewhere

protected:
    void keyPressEvent(QKeyEvent* event) override { emit keyPressed(event); }
    void keyReleaseEvent(QKeyEvent* event) override { emit keyReleased(event); }
    void closeEvent(QCloseEvent* event) override
    {
        event->accept();
        emit closed();
    }
    void changeEvent(QEvent* event) override
    {
        if (event->type() == QEvent::ActivationChange && !isActiveWindow())
            emit left();
        QSplitter::changeEvent(event);
    }
};

}  // namespace vicon::viewer
