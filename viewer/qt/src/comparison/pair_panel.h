#pragma once

#include <QWidget>
#include <vector>

#include "vicon/cases/pair_proposals.h"

class QLabel;
class QPushButton;
class QTableWidget;

namespace vicon::viewer {

/// Markers of two scans that may be one finding, a line each: which, how good, why. The reader confirms.
class PairPanel : public QWidget {
    Q_OBJECT
public:
    explicit PairPanel(QWidget* parent = nullptr);

    /// The pair that was chosen stays so where it is still proposed; else none is.
    void show(std::vector<PairProposal> proposals);

signals:
    /// To the first marker of a line, or to the second where the first is shown already.
    void flyWanted(const vicon::PairProposal& proposal);
    void confirmWanted(const vicon::PairProposal& proposal);

private:
    const PairProposal* chosen() const;
    void select(const PairProposal& proposal);
    void choose();

    std::vector<PairProposal> proposals_;
    QTableWidget* table_;
    QPushButton* confirm_;
    QLabel* words_;
};

}  // namespace vicon::viewer
