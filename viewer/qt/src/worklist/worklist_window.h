#pragma once

#include <QPointer>
#include <QTimer>
#include <QWidget>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "session/own_store.h"
#include "vicon/viewer/qt/reading_room.h"
#include "widgets/worker.h"
#include "widgets/worker_with.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QTableWidget;

namespace vicon::viewer {

class ReadingWindow;

/// The cases of a store by pages, kept up to date; opens them.
class WorklistWindow : public QWidget {
    Q_OBJECT
public:
    WorklistWindow(const ReadingServices& services, const std::string& open_case);
    ~WorklistWindow() override;  ///< waits for reading windows that are closed but still saving

protected:
    void closeEvent(QCloseEvent* event) override;

private:
    /// What the list is read from, and which state of it was read last.
    struct Books {
        explicit Books(StorePlace place) : store(std::move(place)) {}

        OwnStore store;
        std::optional<std::string> version;
        std::optional<WorklistPageWanted> wanted;
    };
    /// What was read of the list.
    struct Listed {
        WorklistPageWanted wanted;
        WorklistPage page;
        std::vector<WorklistCase> beside;  ///< cases in hand that are not on the page

        bool has(const std::string& id) const;  ///< the page
    };
    void buildControls();
    void layOut();
    void connectControls();
    void addKeys();
    WorklistPageWanted wanted() const;
    bool isListed() const;
    void turnTo(std::vector<std::string> pages);
    std::vector<std::string> casesInHand() const;
    void refresh();
    void show(const Listed& listed);
    void showPlace();
    /// In the middle of a list that shows nothing: what can be done.
    QString hintOfNothing() const;
    void renewWindows(const Listed& listed);
    void openSelected();
    const WorklistCase* selected() const;
    void updateButtons();
    void open(const WorklistCase& row);
    void retry();
    void report();

    const ReadingServices services_;
    std::string open_case_;           // to be opened as soon as the list is there
    std::vector<std::string> pages_;  // the last case of each before the one that is shown
    std::optional<WorklistPageWanted> shown_;
    std::vector<WorklistCase> rows_;
    bool more_ = false;              // than these
    bool open_when_listed_ = false;  // what is found first
    QLineEdit* search_;
    QComboBox* state_;
    QTableWidget* table_;
    QLabel *hint_, *reason_, *message_, *page_;
    QPushButton *open_, *retry_, *report_, *newer_, *older_;
    QTimer timer_;
    std::map<std::string, ReadingWindow*> windows_;  ///< open ones, by case
    std::vector<QPointer<QWidget>> made_;            ///< with those that are closed but still saving
    std::shared_ptr<Wanted> report_wanted_;          ///< while it is written
    Worker settings_worker_{this};
    WorkerWith<Books> books_;
};

}  // namespace vicon::viewer
