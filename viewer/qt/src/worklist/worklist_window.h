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
#include "widgets/worker_with.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QTableWidget;

namespace vicon::viewer {

class ReadingWindow;

/// The cases of a store, kept up to date; opens them.
class WorklistWindow : public QWidget {
    Q_OBJECT
public:
    WorklistWindow(const ReadingServices& services, const std::string& open_case);
    ~WorklistWindow() override;  ///< waits for reading windows that are closed but still saving

private:
    /// What the list is read from, and which state of it was read last.
    struct Books {
        explicit Books(StorePlace place) : store(std::move(place)) {}

        OwnStore store;
        std::optional<std::string> version;
    };
    void buildControls();
    void layOut();
    void connectControls();
    void addKeys();
    void refresh();
    void show(const std::vector<WorklistCase>& rows);
    void openSelected();
    void filter();
    /// In the middle of a list that shows nothing: what can be done.
    void showHint();
    const WorklistCase* selected() const;
    void updateButtons();
    void open(const WorklistCase& row);
    void retry();
    void report();

    const ReadingServices services_;
    std::string open_case_;  // to be opened as soon as the list is there
    std::vector<WorklistCase> rows_;
    bool listed_ = false;  // once, at least
    QLineEdit* search_;
    QComboBox* state_;
    QTableWidget* table_;
    QLabel *hint_, *reason_, *message_;
    QPushButton *open_, *retry_, *report_;
    QTimer timer_;
    std::map<std::string, ReadingWindow*> windows_;  ///< open ones, by case
    std::vector<QPointer<QWidget>> made_;            ///< with those that are closed but still saving
    WorkerWith<Books> books_;
};

}  // namespace vicon::viewer
