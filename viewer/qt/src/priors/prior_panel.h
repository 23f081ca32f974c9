#pragma once

#include <QWidget>
#include <optional>

#include "priors/prior_books.h"

class QComboBox;
class QLabel;
class QPushButton;
class QTableWidget;

namespace vicon::viewer {

/// Earlier reports of the patient, a line for each of their findings, and what the reader says of each.
class PriorPanel : public QWidget {
    Q_OBJECT
public:
    explicit PriorPanel(QWidget* parent = nullptr);

    /// The line and the finding of today that were chosen stay so where they are still there; else none is.
    void show(const PriorPage& page);

    /// A finding of an earlier report.
    struct Row {
        std::size_t report = 0;
        std::optional<std::size_t> finding;  ///< none: the report has none
    };
    /// The line that is chosen.
    std::optional<Row> chosen() const;

signals:
    void flyWanted(std::size_t report, std::size_t finding);
    void confirmWanted(const std::string& today, std::size_t report, std::size_t finding, bool confirmed);
    void takeBackWanted(const std::string& today, std::size_t report, std::size_t finding);

private:
    void build();
    void fillRow(int row, const QStringList& cells);
    void choose();
    /// What can be said now.
    void allow();
    void fillFindings();
    /// Of a report and of its finding; this one is empty where the report has none.
    using Uids = std::pair<std::string, std::string>;
    Uids uidsOf(const Row& row) const;
    std::optional<Uids> chosenUids() const;
    std::vector<const ComparedFinding*> saidOf(const Row& row) const;
    std::string today() const;
    QString todayOf(const Row& row) const;

    PriorPage page_;
    std::vector<Row> rows_;
    std::optional<Uids> filled_for_;  // the line whose findings of today are offered
    QTableWidget* table_;
    QComboBox* findings_;
    QPushButton *confirm_, *reject_, *take_back_;
    QLabel* words_;
};

}  // namespace vicon::viewer
