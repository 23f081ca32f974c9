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
    void fillFindings(const PriorMatch& match, const std::vector<const ComparedFinding*>& said);
    std::string today() const;
    QString todayOf(const Row& row) const;

    PriorPage page_;
    std::vector<Row> rows_;
    QTableWidget* table_;
    QComboBox* findings_;
    QPushButton *confirm_, *reject_, *take_back_;
    QLabel* words_;
};

}  // namespace vicon::viewer
