#include "comparison/pair_panel.h"

#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>
#include <optional>

#include "widgets/panel_parts.h"

namespace vicon::viewer {
namespace {

enum PairColumn { kPairMarkers, kPairRank, kPairWhy, kPairColumns };
constexpr int kLeastPairs = 3;

}  // namespace

PairPanel::PairPanel(QWidget* parent) : QWidget(parent)
{
    setObjectName("pairPanel");
    table_ = new QTableWidget(0, kPairColumns, this);
    table_->setObjectName("pairs");
    table_->setAccessibleName(tr("Proposed pairs"));
    table_->setToolTip(tr("Click or Return: to the one marker, beside it the other; once more: to the other"));
    table_->setHorizontalHeaderLabels({tr("Markers"), tr("Rank"), tr("Why")});
    setUpList(table_, kLeastPairs);
    table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    table_->horizontalHeader()->setStretchLastSection(true);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    confirm_ = new QPushButton(tr("One finding: pair them"), this);
    confirm_->setObjectName("pairConfirm");
    confirm_->setToolTip(tr("The two markers become a pair; Ctrl+Z takes it back"));
    words_ = new QLabel(this);
    words_->setObjectName("pairWords");
    words_->setWordWrap(true);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(2, 2, 2, 2);
    column->addWidget(table_);
    column->addWidget(words_);
    column->addWidget(confirm_);
    for (const auto by : {&QTableWidget::cellClicked, &QTableWidget::cellActivated})
        connect(table_, by, this, [this](int row, int) {
            if (row < int(proposals_.size()))
                emit flyWanted(proposals_[std::size_t(row)]);
        });
    connect(table_, &QTableWidget::itemSelectionChanged, this, &PairPanel::choose);
    connect(confirm_, &QPushButton::clicked, this, [this] {
        if (const PairProposal* proposal = chosen())
            emit confirmWanted(PairProposal(*proposal));  // the list may be filled anew meanwhile
    });
    choose();
}

void PairPanel::show(std::vector<PairProposal> proposals)
{
    std::optional<PairProposal> before;
    if (const PairProposal* proposal = chosen())
        before = *proposal;
    proposals_ = std::move(proposals);
    table_->setRowCount(int(proposals_.size()));
    for (int row = 0; row < table_->rowCount(); ++row) {
        const PairProposal& p = proposals_[std::size_t(row)];
        const QStringList cells{tr("%1 and %2").arg(p.first.c_str(), p.second.c_str()), QString::number(p.rank),
                                QString::fromStdString(p.reason)};
        for (int column = 0; column < kPairColumns; ++column) {
            table_->setItem(row, column, new QTableWidgetItem(cells[column]));
            table_->item(row, column)->setToolTip(cells[kPairWhy]);
        }
    }
    table_->clearSelection();  // where the chosen pair is gone, another one is in its row
    if (before)
        select(*before);
    choose();
}

void PairPanel::select(const PairProposal& proposal)
{
    for (std::size_t row = 0; row < proposals_.size(); ++row)
        if (proposals_[row].first == proposal.first && proposals_[row].second == proposal.second)
            table_->selectRow(int(row));
}

const PairProposal* PairPanel::chosen() const
{
    const auto rows = table_->selectionModel()->selectedRows();
    if (rows.empty() || rows.front().row() >= int(proposals_.size()))
        return nullptr;
    return &proposals_[std::size_t(rows.front().row())];
}

void PairPanel::choose()
{
    const PairProposal* proposal = chosen();
    if (!proposal && confirm_->hasFocus())
        table_->setFocus();  // the next pair is chosen there
    confirm_->setEnabled(proposal != nullptr);
    words_->setText(proposal             ? QString::fromStdString(proposal->reason)
                    : proposals_.empty() ? tr("No two markers of different scans may be one finding.")
                                         : QString());
}

}  // namespace vicon::viewer
