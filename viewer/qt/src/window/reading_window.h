#pragma once

#include <QElapsedTimer>
#include <QMainWindow>
#include <QTimer>
#include <memory>
#include <vector>

#include "vicon/viewer/qt/reading_room.h"

class QAction;

namespace vicon::viewer {

class OpeningTool;
class Reading;
class ReadingLayout;
class ReadingTool;
class ReadingViews;
class Worker;

/// A case in reading: puts together the views, the tools and the menus, and ends them.
class ReadingWindow : public QMainWindow {
    Q_OBJECT
public:
    ReadingWindow(const ReadingServices& services, const WorklistCase& row);
    ~ReadingWindow() override;

    /// As the worklist shows the case by now: scans that became ready are offered, one that was done again for another
    /// reader is shown anew.
    void renew(const WorklistCase& row);
    /// What the reader set by now is found in the next case that is opened.
    void keep();

signals:
    /// The window is gone; it deletes itself when its threads have ended.
    void closed();

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void changeEvent(QEvent* event) override;
    void closeEvent(QCloseEvent* event) override;

private:
    void addEditActions();
    void addWindowActions();
    void connectAll();
    void restore();
    void endThreads();

    ReadingViews* views_;
    ReadingLayout* layout_;
    QAction* two_windows_ = nullptr;
    std::unique_ptr<Reading> reading_;
    OpeningTool* opening_ = nullptr;
    std::vector<std::unique_ptr<ReadingTool>> tools_;
    QTimer poll_;
    std::vector<Worker*> workers_;  // once the window is closed
};

}  // namespace vicon::viewer
