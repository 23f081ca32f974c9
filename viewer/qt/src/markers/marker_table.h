#pragma once

#include <QPointer>
#include <QWidget>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/marker.h"

class QTableWidget;
class QPushButton;
class QComboBox;

namespace vicon::viewer {

/// The markers of a case; the note can be written in its cell.
class MarkerTable : public QWidget {
    Q_OBJECT
public:
    explicit MarkerTable(QWidget* parent = nullptr);

    /// @param positions of the scans by id: "supine", "prone"
    void show(const std::vector<Marker>& markers, const std::map<std::string, std::string>& positions);
    /// What the column of distances means; empty: there are none.
    void setStationTip(const QString& tip);
    void setUndo(bool can_undo, bool can_redo);
    /// Nothing can be changed meanwhile, but a note that is being written is written on; who had the keyboard gets it
    /// back.
    void setBusy(bool busy);
    bool isBusy() const { return busy_; }
    std::optional<Marker> selected() const;
    void select(const std::string& id);
    /// Begins to write the note of the chosen marker, else of the first.
    void writeNote();

signals:
    void flyWanted(const vicon::Marker& marker);
    void changed(const vicon::Marker& before, const vicon::Marker& after);
    void removeWanted(const vicon::Marker& marker);
    void pairWanted(const vicon::Marker& marker);
    void moveWanted(const vicon::Marker& marker);
    void undoWanted();
    void redoWanted();

private:
    void buildTable();
    void buildButtons();
    void connectTable();
    void connectButtons();
    void updateButtons();
    void updateEnabled();
    void noteEdited(int row, int column);
    /// In which row a note is being written.
    std::optional<int> rowWritten() const;
    void editNote(int row);
    void fillRow(int row, bool written);
    void writingEnded();

    std::vector<Marker> markers_;  // of a note that is being written the one that was seen when that began
    std::map<std::string, std::string> positions_;
    std::optional<Marker> newer_;  // the one as it is by now
    bool filling_ = false, busy_ = false;
    QPointer<QWidget> had_focus_;
    QTableWidget* table_;
    QComboBox* color_;
    QPushButton *go_, *move_, *pair_, *remove_, *undo_, *redo_;
};

}  // namespace vicon::viewer
