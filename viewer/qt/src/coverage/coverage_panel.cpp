#include "coverage/coverage_panel.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <algorithm>

#include "widgets/panel_parts.h"

namespace vicon::viewer {
namespace {
enum UnseenColumn { kUnseenStation, kUnseenPart, kArea, kUnseenColumns };
constexpr int kLeastPatches = 4;
constexpr double kMostArea_mm2 = 1000;
}  // namespace

CoveragePanel::CoveragePanel(QWidget* parent) : QWidget(parent)
{
    const auto named = [](auto* widget, const char* name, const QString& title, const QString& tip) {
        widget->setObjectName(name);
        widget->setAccessibleName(title);
        widget->setToolTip(tip);
        return widget;
    };
    text_ = named(new QLabel(this), "seen", tr("Wall seen"),
                  tr("Part of the wall's area in the endoscopic pictures shown so far; the way it was looked at does "
                     "not count"));
    paint_ = named(new QCheckBox(tr("paint what was seen"), this), "paintSeen", tr("Paint what was seen"),
                   tr("Tint the wall that was seen before the last turn or jump (V); what stays in its own colour is "
                      "new"));
    table_ = named(new QTableWidget(0, kUnseenColumns, this), "unseen", tr("Unseen patches"),
                   tr("Click or Return: fly there"));
    table_->setHorizontalHeaderLabels({tr("mm"), tr("Part"), tr("mm² unseen")});
    setUpList(table_, kLeastPatches);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    least_ = named(new QDoubleSpinBox(this), "leastUnseen", tr("Least area of an unseen patch"),
                   tr("Smaller patches are not listed; a polyp of 6 mm hides behind 28 mm²"));
    least_->setRange(1, kMostArea_mm2);
    least_->setDecimals(0);
    least_->setSuffix(tr(" mm²"));
    least_->setValue(UnseenOptions().least_area_mm2);
    list_ = named(new QPushButton(tr("List anew"), this), "listUnseen", tr("List the unseen patches"),
                  tr("Look for the patches that are unseen by now"));
    forget_ = named(new QPushButton(tr("Start again"), this), "forgetSeen", tr("Forget what was seen"),
                    tr("Count from nothing, as before the first flight"));

    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(2, 2, 2, 2);
    grid->addWidget(text_, 0, 0, 1, 2);
    grid->addWidget(paint_, 0, 2, 1, 2);
    grid->addWidget(table_, 1, 0, 1, 4);
    auto* over = new QLabel(tr("from"), this);
    over->setBuddy(least_);
    grid->addWidget(over, 2, 0);
    grid->addWidget(least_, 2, 1);
    grid->addWidget(list_, 2, 2);
    grid->addWidget(forget_, 2, 3);
    connect(paint_, &QCheckBox::toggled, this, &CoveragePanel::paintWanted);
    connect(least_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &CoveragePanel::listWanted);
    connect(list_, &QPushButton::clicked, this, &CoveragePanel::listWanted);
    connect(forget_, &QPushButton::clicked, this, &CoveragePanel::forgetWanted);
    for (const auto chosen : {&QTableWidget::cellClicked, &QTableWidget::cellActivated})
        connect(table_, chosen, this, [this](int row, int) {
            if (row < int(patches_.size()))
                emit flyWanted(patches_[std::size_t(row)]);
        });
    setSeen(0);
}

void CoveragePanel::setStationTip(const QString& tip)
{
    table_->horizontalHeaderItem(kUnseenStation)->setToolTip(tip);
}

void CoveragePanel::setSeen(double fraction)
{
    // Rounded down: 100 % is what nothing is missing from.
    text_->setText(tr("%1 % of the wall seen").arg(int(fraction * 1000) / 10.0, 0, 'f', 1));
}

void CoveragePanel::show(std::vector<UnseenPatch> patches, const ColonPartRanges& parts)
{
    std::stable_sort(patches.begin(), patches.end(),
                     [](const UnseenPatch& a, const UnseenPatch& b) { return a.station_mm < b.station_mm; });
    patches_ = std::move(patches);
    table_->clearSelection();
    table_->setRowCount(int(patches_.size()));
    for (int row = 0; row < table_->rowCount(); ++row) {
        const UnseenPatch& patch = patches_[std::size_t(row)];
        const QStringList cells{QString::number(patch.station_mm, 'f', 0),
                                QString::fromStdString(partNameAt(parts, patch.station_mm)),
                                QString::number(patch.area_mm2, 'f', 0)};
        for (int column = 0; column < kUnseenColumns; ++column)
            table_->setItem(row, column, new QTableWidgetItem(cells[column]));
    }
}

bool CoveragePanel::paints() const
{
    return paint_->isChecked();
}

void CoveragePanel::setPaints(bool on)
{
    paint_->setChecked(on);
}

double CoveragePanel::least_mm2() const
{
    return least_->value();
}

}  // namespace vicon::viewer
