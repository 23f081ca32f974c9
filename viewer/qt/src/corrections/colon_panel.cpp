#include "corrections/colon_panel.h"

#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QTableWidget>

#include "widgets/panel_parts.h"

namespace vicon::viewer {
namespace {
constexpr int kLeastBridges = 4, kButtons = 6, kStateColumns = 2;
enum BridgeColumn { kBridgeStation, kLength, kConfidence, kVerdict, kBridgeColumns };
}  // namespace

QPushButton* ColonPanel::button(const QString& title, const char* name, const QString& tip)
{
    auto* made = new QPushButton(title, this);
    made->setObjectName(name);
    made->setAccessibleName(title);
    made->setToolTip(tip);
    tighten(made);
    return made;
}

ColonPanel::ColonPanel(QWidget* parent) : QWidget(parent)
{
    setObjectName("colonPanel");
    table_ = new QTableWidget(0, kBridgeColumns, this);
    table_->setObjectName("bridges");
    table_->setAccessibleName(tr("Bridges over collapsed segments"));
    table_->setToolTip(tr("Where the pipeline joined two pieces of lumen. Click or Return: fly there."));
    table_->setHorizontalHeaderLabels({tr("mm"), tr("Bridge"), tr("Confidence"), tr("Judged")});
    setUpList(table_, kLeastBridges);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    confirm_ = button(tr("Confirm"), "confirmBridge", tr("The two pieces belong together"));
    reject_ = button(tr("Reject"), "rejectBridge", tr("They do not; kept with your name and printed in the report"));
    auto* add = button(tr("Add ..."), "correctAdd", tr("Then click on gas or fluid that belongs to the colon"));
    auto* cut = button(tr("Cut ..."), "correctCut",
                       tr("Then click into the lumen where it is cut across; the smaller part is dropped"));
    auto* drop = button(tr("Drop ..."), "correctDrop", tr("Then click on a piece that is not colon"));
    auto* forget = button(tr("Forget"), "forgetCorrections", tr("Take back all corrections of this scan"));
    stop_ = button(tr("Stop"), "stopRedo", tr("Stop the work; the job waits in the queue"));
    state_ = new QLabel(this);
    state_->setObjectName("redoState");
    state_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);  // what it says makes no column wider
    bar_ = new QProgressBar(this);
    bar_->setObjectName("redo");
    bar_->setAccessibleName(tr("Progress of the scan that is done again"));

    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(2, 2, 2, 2);
    grid->addWidget(table_, 0, 0, 1, kButtons);
    grid->addWidget(confirm_, 1, 0);
    grid->addWidget(reject_, 1, 1);
    grid->addWidget(add, 1, 2);
    grid->addWidget(cut, 1, 3);
    grid->addWidget(drop, 1, 4);
    grid->addWidget(forget, 1, 5);
    grid->addWidget(bar_, 2, kStateColumns, 1, kButtons - kStateColumns - 1);
    grid->addWidget(stop_, 2, kButtons - 1);
    connect(table_, &QTableWidget::itemSelectionChanged, this, &ColonPanel::updateButtons);
    for (const auto chosen : {&QTableWidget::cellClicked, &QTableWidget::cellActivated})
        connect(table_, chosen, this,
                [this](int row, int) { emit flyWanted(bridges_[std::size_t(row)].bridge.from_mm); });
    for (QPushButton* verdict : {confirm_, reject_})
        connect(verdict, &QPushButton::clicked, this, [this, verdict] {
            if (const auto bridge = selected())
                emit reviewed(*bridge, verdict == confirm_);
        });
    connect(add, &QPushButton::clicked, this, [this] { emit correctionWanted(Correction::add); });
    connect(cut, &QPushButton::clicked, this, [this] { emit correctionWanted(Correction::cut); });
    connect(drop, &QPushButton::clicked, this, [this] { emit correctionWanted(Correction::drop); });
    connect(forget, &QPushButton::clicked, this, &ColonPanel::forgetWanted);
    connect(stop_, &QPushButton::clicked, this, &ColonPanel::stopWanted);
    showProgress({}, -1);
    updateButtons();
}

void ColonPanel::show(const std::vector<ReviewedBridge>& bridges, const Skeleton& skeleton)
{
    bridges_ = bridges;
    table_->setRowCount(int(bridges.size()));
    for (int row = 0; row < int(bridges.size()); ++row) {
        const auto& [bridge, review] = bridges[std::size_t(row)];
        const QString judged = review ? tr("%1, %2").arg(QString::fromStdString(nameOf(review->verdict)),
                                                         QString::fromStdString(review->by))
                                      : tr("not reviewed");
        const QStringList cells{QString::number(skeleton.nearest(bridge.from_mm).station_mm, 'f', 0),
                                tr("%1 mm").arg(bridge.length_mm, 0, 'f', 0),
                                tr("%1 %").arg(100 * bridge.confidence, 0, 'f', 0), judged};
        for (int column = 0; column < kBridgeColumns; ++column) {
            auto* item = new QTableWidgetItem(cells[column]);
            item->setToolTip(QString::fromStdString(bridge.reason + (review ? "; judged " + review->at : "")));
            if (!bridge.certain && column == kConfidence)
                item->setForeground(QColor(255, 154, 74));
            table_->setItem(row, column, item);
        }
    }
    for (int column = 0; column < kVerdict; ++column)
        table_->resizeColumnToContents(column);
    updateButtons();
}

void ColonPanel::showProgress(const QString& what, double fraction)
{
    const bool under_way = fraction >= 0;
    state_->setText(what);
    qobject_cast<QGridLayout*>(layout())->addWidget(state_, 2, 0, 1, under_way ? kStateColumns : kButtons);
    bar_->setVisible(under_way);
    stop_->setVisible(under_way);
    bar_->setValue(int(100 * fraction));
}

std::optional<ReviewedBridge> ColonPanel::selected() const
{
    const auto rows = table_->selectionModel()->selectedRows();
    if (rows.empty() || rows.front().row() >= int(bridges_.size()))
        return std::nullopt;
    return bridges_[std::size_t(rows.front().row())];
}

void ColonPanel::updateButtons()
{
    confirm_->setEnabled(selected().has_value());
    reject_->setEnabled(selected().has_value());
}

}  // namespace vicon::viewer
