#include "markers/marker_table.h"

#include <QApplication>
#include <QComboBox>
#include <QGridLayout>
#include <QHeaderView>
#include <QPushButton>
#include <QTableWidget>
#include <algorithm>
#include <map>

#include "vicon/cases/case_store.h"
#include "vicon/cases/finding_facts.h"
#include "vicon/viewer/model/annotate.h"
#include "widgets/panel_parts.h"

namespace vicon::viewer {
namespace {

constexpr int kLeastRows = 5, kGap_px = 3;
enum Column { kId, kScan, kStation, kPart, kPair, kSize, kNote, kColumns };

QString text(const std::string& utf8)
{
    return QString::fromStdString(utf8);
}

QString sizeCell(const Marker& marker)
{
    return marker.size ? QString::number(largestDiameter_mm(*marker.size), 'f', 1) : QString();
}

QColor qtColor(MarkerColor color)
{
    const Rgb c = colorOf(color);
    return {c.red, c.green, c.blue};
}

}  // namespace

MarkerTable::MarkerTable(QWidget* parent) : QWidget(parent)
{
    setObjectName("markerTable");
    buildTable();
    buildButtons();
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(2, 2, 2, 2);
    const std::initializer_list<QWidget*> controls{go_, color_, move_, pair_, remove_, undo_, redo_};
    grid->setHorizontalSpacing(kGap_px);
    grid->addWidget(table_, 0, 0, 1, int(controls.size()));
    int column = 0;
    for (QWidget* control : controls)
        grid->addWidget(control, 1, column++);
    connectTable();
    connectButtons();
    updateButtons();
}

void MarkerTable::buildTable()
{
    table_ = new QTableWidget(0, kColumns, this);
    table_->setObjectName("markers");
    table_->setAccessibleName(tr("Markers"));
    table_->setHorizontalHeaderLabels(
        {tr("ID"), tr("Scan"), tr("mm"), tr("Segment"), tr("Pair"), tr("Size"), tr("Note")});
    setUpList(table_, kLeastRows);
    table_->horizontalHeaderItem(kSize)->setToolTip(
        tr("Largest diameter in mm: the longer one of the straight line between the clicked ends and the diameter in "
           "the best plane (M). C-RADS: the polyp's head without its stalk."));
    table_->setToolTip(tr("Click or Return: fly there. Double click on the note, or N: write it."));
}

void MarkerTable::buildButtons()
{
    const auto button = [this](const QString& title, const char* name, const QString& tip) {
        auto* made = new QPushButton(title, this);
        made->setObjectName(name);
        made->setToolTip(tip);
        made->setAccessibleName(title);
        tighten(made);
        return made;
    };
    go_ = button(tr("Show"), "markerGo", tr("Fly to the marker and show its saved view"));
    color_ = new QComboBox(this);
    color_->setObjectName("markerColor");
    color_->setAccessibleName(tr("Colour of the marker"));
    color_->addItems({tr("red"), tr("yellow"), tr("green")});
    move_ = button(tr("Move"), "markerMove", tr("Then click on its new place in any view"));
    pair_ = button(tr("Pair"), "markerPair", tr("Then choose the same finding in another scan; again: separate them"));
    remove_ = button(tr("Delete"), "markerRemove", tr("Delete the marker (Delete)"));
    undo_ = button(tr("Undo"), "undo", tr("Undo the last change (Ctrl+Z)"));
    redo_ = button(tr("Redo"), "redo", tr("Do it again (Ctrl+Y)"));
}

void MarkerTable::connectTable()
{
    connect(table_, &QTableWidget::itemSelectionChanged, this, &MarkerTable::updateButtons);
    connect(table_, &QTableWidget::cellClicked, this, [this](int, int column) {
        if (const auto marker = selected(); marker && column != kNote)
            emit flyWanted(*marker);
    });
    // By Return; a double click on a note begins to write it and activates nothing.
    connect(table_, &QTableWidget::cellActivated, this, [this] {
        if (const auto marker = selected())
            emit flyWanted(*marker);
    });
    connect(table_, &QTableWidget::cellChanged, this, &MarkerTable::noteEdited);
}

void MarkerTable::connectButtons()
{
    const auto ask = [this](QPushButton* from, void (MarkerTable::*signal)(const Marker&)) {
        connect(from, &QPushButton::clicked, this, [this, signal] {
            if (const auto marker = selected())
                emit(this->*signal)(*marker);
        });
    };
    ask(go_, &MarkerTable::flyWanted);
    ask(move_, &MarkerTable::moveWanted);
    ask(pair_, &MarkerTable::pairWanted);
    ask(remove_, &MarkerTable::removeWanted);
    connect(undo_, &QPushButton::clicked, this, &MarkerTable::undoWanted);
    connect(redo_, &QPushButton::clicked, this, &MarkerTable::redoWanted);
    connect(color_, qOverload<int>(&QComboBox::activated), this, [this](int index) {
        if (const auto before = selected()) {
            Marker after = *before;
            after.color = MarkerColor(index);
            if (after.color != before->color)
                emit changed(*before, after);
        }
    });
}

void MarkerTable::show(const std::vector<Marker>& markers, const std::map<std::string, std::string>& positions)
{
    const auto chosen = selected();
    filling_ = true;
    markers_ = markers;
    table_->setRowCount(int(markers.size()));
    for (int row = 0; row < int(markers.size()); ++row) {
        const Marker& m = markers[std::size_t(row)];
        const auto position = positions.find(m.scan_id);
        const QStringList cells{text(m.id),
                                position == positions.end() ? text(m.scan_id) : text(position->second),
                                QString::number(m.station_mm, 'f', 0),
                                m.part ? text(nameOf(*m.part)) : QString(),
                                text(partnerNames(m)),
                                sizeCell(m),
                                text(m.note)};
        for (int column = 0; column < kColumns; ++column) {
            auto* item = new QTableWidgetItem(cells[column]);
            if (column != kNote)
                item->setFlags(item->flags() & ~Qt::ItemIsEditable);
            if (column == kId)
                item->setForeground(qtColor(m.color));
            table_->setItem(row, column, item);
        }
    }
    for (int column = 0; column < kNote; ++column)
        table_->resizeColumnToContents(column);
    filling_ = false;
    table_->clearSelection();  // where the chosen marker is gone, the next one is in its row
    if (chosen)
        select(chosen->id);
    updateButtons();
}

void MarkerTable::setStationTip(const QString& tip)
{
    table_->horizontalHeaderItem(kStation)->setToolTip(tip);
    table_->setColumnHidden(kStation, tip.isEmpty());
}

void MarkerTable::setUndo(bool can_undo, bool can_redo)
{
    undo_->setEnabled(can_undo);
    redo_->setEnabled(can_redo);
}

void MarkerTable::setBusy(bool busy)
{
    if (QWidget* focused = QApplication::focusWidget(); busy)
        had_focus_ = !focused || !isAncestorOf(focused) ? nullptr
                     : table_->isAncestorOf(focused)    ? table_  // the note's editor is gone by then
                                                        : focused;
    setEnabled(!busy);
    if (!busy && had_focus_ && !QApplication::focusWidget())
        had_focus_->setFocus();
}

std::optional<Marker> MarkerTable::selected() const
{
    const auto rows = table_->selectionModel()->selectedRows();
    if (rows.empty() || rows.front().row() >= int(markers_.size()))
        return std::nullopt;
    return markers_[std::size_t(rows.front().row())];
}

void MarkerTable::select(const std::string& id)
{
    for (std::size_t row = 0; row < markers_.size(); ++row)
        if (markers_[row].id == id)
            table_->selectRow(int(row));
}

void MarkerTable::writeNote()
{
    if (markers_.empty() || !isEnabled())
        return;
    if (!selected())
        table_->selectRow(0);
    const int row = table_->selectionModel()->selectedRows().front().row();
    table_->setCurrentCell(row, kNote);
    table_->setFocus(Qt::ShortcutFocusReason);
    table_->editItem(table_->item(row, kNote));
}

void MarkerTable::updateButtons()
{
    const auto marker = selected();
    for (QWidget* widget : std::initializer_list<QWidget*>{go_, color_, move_, pair_, remove_})
        widget->setEnabled(marker.has_value());
    if (marker)
        color_->setCurrentIndex(int(marker->color));
}

void MarkerTable::noteEdited(int row, int column)
{
    if (filling_ || column != kNote || row >= int(markers_.size()))
        return;
    const Marker before = markers_[std::size_t(row)];
    Marker after = before;
    after.note = table_->item(row, column)->text().toStdString();
    if (after.note != before.note)
        emit changed(before, after);
}

}  // namespace vicon::viewer
