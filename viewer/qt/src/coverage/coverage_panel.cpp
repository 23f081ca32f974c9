#include "coverage/coverage_panel.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPixmap>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTableWidget>

#include "vicon/viewer/scene/snapshot.h"
#include "widgets/panel_parts.h"

namespace vicon::viewer {
namespace {

enum MissedColumn { kMissedPicture, kMissedStation, kMissedSegment, kMissedArea, kMissedColumns };
constexpr int kLeastRegions = 2, kPicture_px = 56;  // of 96 to the inch
constexpr double kMostArea_mm2 = 5000;

}  // namespace

CoveragePanel::CoveragePanel(QWidget* parent) : QWidget(parent)
{
    setObjectName("coverage");
    const auto named = [](auto* widget, const char* name, const QString& title, const QString& tip) {
        widget->setObjectName(name);
        widget->setAccessibleName(title);
        widget->setToolTip(tip);
        return widget;
    };
    text_ =
        named(new QLabel(this), "seen", tr("Wall reviewed"),
              tr("Share of the wall that was on the screen under less than 60 degrees, with 3 pixels a millimetre or "
                 "more, for a tenth of a second or longer"));
    paint_ = named(new QCheckBox(tr("paint it"), this), "paintSeen", tr("Paint what was reviewed"),
                   tr("Tint the wall that was reviewed before the last turn or jump (V); what stays in its own colour "
                      "is new"));
    table_ = named(new QTableWidget(0, kMissedColumns, this), "unseen", tr("Missed regions"),
                   tr("Click or Return: fly there"));
    table_->setHorizontalHeaderLabels({{}, tr("mm"), tr("Segment"), tr("mm² missed")});
    setUpList(table_, kLeastRegions);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setIconSize({kPicture_px, kPicture_px});
    table_->setMinimumHeight(table_->horizontalHeader()->sizeHint().height() + kLeastRegions * (kPicture_px + 4));
    table_->verticalHeader()->setDefaultSectionSize(kPicture_px + 4);
    table_->setColumnWidth(kMissedPicture, kPicture_px + 24);
    table_->setColumnWidth(kMissedStation, table_->fontMetrics().horizontalAdvance("00000"));
    least_ = named(new QDoubleSpinBox(this), "leastUnseen", tr("Least area of a missed region"),
                   tr("Smaller regions are not listed; a polyp of 6 mm hides behind 28 mm²"));
    least_->setRange(1, kMostArea_mm2);
    least_->setDecimals(0);
    least_->setSuffix(tr(" mm²"));
    least_->setValue(kMissedRegion_mm2);
    next_ = named(new QPushButton(tr("Next"), this), "nextMissed", tr("Next missed region"),
                  tr("Fly to the next region that is not reviewed (F3)"));
    list_ = named(new QPushButton(tr("List anew"), this), "listUnseen", tr("List the missed regions"),
                  tr("Look for the regions that are missed by now"));
    forget_ = named(new QPushButton(tr("Start again"), this), "forgetSeen", tr("Forget what was reviewed"),
                    tr("Count from nothing, as before the first flight"));
    layOut();
    connectAll();
    setSeen(0);
}

void CoveragePanel::layOut()
{
    constexpr int kColumns = 5;
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(2, 2, 2, 2);
    grid->addWidget(text_, 0, 0, 1, 3);
    grid->addWidget(paint_, 0, 3, 1, 2);
    grid->addWidget(table_, 1, 0, 1, kColumns);
    auto* over = new QLabel(tr("from"), this);
    over->setBuddy(least_);
    QWidget* const row[kColumns] = {over, least_, next_, list_, forget_};
    for (int column = 0; column < kColumns; ++column)
        grid->addWidget(row[column], 2, column);
    for (QPushButton* button : {next_, list_, forget_})
        tighten(button);
}

void CoveragePanel::connectAll()
{
    connect(paint_, &QCheckBox::toggled, this, &CoveragePanel::paintWanted);
    connect(least_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &CoveragePanel::listWanted);
    connect(next_, &QPushButton::clicked, this, &CoveragePanel::nextWanted);
    connect(list_, &QPushButton::clicked, this, &CoveragePanel::listWanted);
    connect(forget_, &QPushButton::clicked, this, &CoveragePanel::forgetWanted);
    for (const auto chosen : {&QTableWidget::cellClicked, &QTableWidget::cellActivated})
        connect(table_, chosen, this, [this](int row, int) { emit flyWanted(row); });
}

void CoveragePanel::setStationTip(const QString& tip)
{
    table_->horizontalHeaderItem(kMissedStation)->setToolTip(tip);
    table_->setColumnHidden(kMissedStation, tip.isEmpty());
}

void CoveragePanel::setSeen(double fraction)
{
    // Rounded down: 100 % is what nothing is missing from.
    text_->setText(tr("%1 % of the wall reviewed").arg(int(fraction * 1000) / 10.0, 0, 'f', 1));
}

void CoveragePanel::show(const MissedRegions& missed, const ColonPartRanges& parts)
{
    table_->clearSelection();
    table_->setRowCount(int(missed.regions().size()));
    for (int row = 0; row < table_->rowCount(); ++row) {
        const UnseenPatch& region = missed.regions()[std::size_t(row)];
        const QStringList cells{{},
                                QString::number(region.station_mm, 'f', 0),
                                QString::fromStdString(partNameAt(parts, region.station_mm)),
                                QString::number(region.area_mm2, 'f', 0)};
        for (int column = 0; column < kMissedColumns; ++column)
            table_->setItem(row, column, new QTableWidgetItem(cells[column]));
    }
    mark(missed);
}

void CoveragePanel::mark(const MissedRegions& missed)
{
    for (int row = 0; row < table_->rowCount(); ++row) {
        const bool done = missed.done(std::size_t(row));
        table_->item(row, kMissedPicture)->setText(done ? QString(QChar(0x2713)) : QString());  // a tick
        table_->item(row, kMissedPicture)->setToolTip(done ? tr("reviewed") : tr("not reviewed"));
    }
    if (missed.visited())
        table_->selectRow(int(*missed.visited()));
}

void CoveragePanel::setPicture(int region, const QPixmap& picture)
{
    if (QTableWidgetItem* item = table_->item(region, kMissedPicture))
        item->setIcon(QIcon(picture));
}

QSize CoveragePanel::pictureSize()
{
    return {SnapshotRequest::kLeastSide, SnapshotRequest::kLeastSide};
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

void CoveragePanel::setLeast(double least_mm2)
{
    const QSignalBlocker quiet(least_);
    least_->setValue(least_mm2);
}

}  // namespace vicon::viewer
