#include "markers/marker_table.h"

#include <QAbstractItemDelegate>
#include <QApplication>
#include <QComboBox>
#include <QGridLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <algorithm>
#include <map>
#include <utility>

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
    connect(table_->itemDelegate(), &QAbstractItemDelegate::closeEditor, this, &MarkerTable::writingEnded);
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
    const auto written = rowWritten();
    const auto seen = written ? std::optional(markers_[std::size_t(*written)]) : std::nullopt;
    const bool stays = seen && *written < int(markers.size()) && markers[std::size_t(*written)].id == seen->id;
    const auto* editor = seen ? table_->viewport()->findChild<QLineEdit*>() : nullptr;
    const QString text_so_far = editor ? editor->text() : QString();
    newer_.reset();
    if (seen && !stays)
        table_->closePersistentEditor(table_->item(*written, kNote));
    markers_ = markers;
    positions_ = positions;
    table_->setRowCount(int(markers.size()));
    for (int row = 0; row < int(markers.size()); ++row)
        fillRow(row, stays && row == *written);
    for (int column = 0; column < kNote; ++column)
        table_->resizeColumnToContents(column);
    if (stays) {
        newer_ = markers_[std::size_t(*written)];
        markers_[std::size_t(*written)].note = seen->note;
        updateButtons();
        return;
    }
    table_->clearSelection();  // where the chosen marker is gone, the next one is in its row
    if (chosen)
        select(chosen->id);
    for (int row = 0; row < int(markers.size()) && seen; ++row)
        if (markers[std::size_t(row)].id == seen->id) {
            editNote(row);
            if (auto* again = table_->viewport()->findChild<QLineEdit*>())
                again->setText(text_so_far);
        }
    updateEnabled();
}

void MarkerTable::fillRow(int row, bool written)
{
    const Marker& m = markers_[std::size_t(row)];
    const auto position = positions_.find(m.scan_id);
    const QStringList cells{text(m.id),
                            position == positions_.end() ? text(m.scan_id) : text(position->second),
                            QString::number(m.station_mm, 'f', 0),
                            m.part ? text(nameOf(*m.part)) : QString(),
                            text(partnerNames(m)),
                            sizeCell(m),
                            text(m.note)};
    filling_ = true;
    for (int column = 0; column < (written ? kNote : kColumns); ++column) {
        auto* item = new QTableWidgetItem(cells[column]);
        if (column != kNote)
            item->setFlags(item->flags() & ~Qt::ItemIsEditable);
        if (column == kId)
            item->setForeground(qtColor(m.color));
        table_->setItem(row, column, item);
    }
    filling_ = false;
}

/// Where nothing is being saved that would show it.
void MarkerTable::writingEnded()
{
    const auto newer = std::exchange(newer_, {});
    for (std::size_t row = 0; newer && !busy_ && row < markers_.size(); ++row)
        if (markers_[row].id == newer->id) {
            markers_[row] = *newer;
            fillRow(int(row), false);
        }
    updateEnabled();
}

std::optional<int> MarkerTable::rowWritten() const
{
    for (int row = 0; row < table_->rowCount() && row < int(markers_.size()); ++row)
        if (auto* note = table_->item(row, kNote); note && table_->isPersistentEditorOpen(note))
            return row;
    return std::nullopt;
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
    if (std::exchange(busy_, busy) == busy)
        return;
    if (QWidget* focused = QApplication::focusWidget(); busy)
        had_focus_ = !focused || !isAncestorOf(focused) ? nullptr
                     : table_->isAncestorOf(focused)    ? table_  // the note's editor is gone by then
                                                        : focused;
    updateEnabled();
    if (!busy && had_focus_ && !QApplication::focusWidget())
        had_focus_->setFocus();
}

void MarkerTable::updateEnabled()
{
    setEnabled(!busy_ || rowWritten());  // disabled, the table would end what is being written, and save it
    updateButtons();
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
    if (markers_.empty() || busy_)
        return;
    if (!selected())
        table_->selectRow(0);
    table_->setFocus(Qt::ShortcutFocusReason);
    editNote(table_->selectionModel()->selectedRows().front().row());
}

void MarkerTable::editNote(int row)
{
    table_->setCurrentCell(row, kNote);
    table_->editItem(table_->item(row, kNote));
}

void MarkerTable::updateButtons()
{
    const auto marker = selected();
    for (QWidget* widget : std::initializer_list<QWidget*>{go_, color_, move_, pair_, remove_})
        widget->setEnabled(marker.has_value() && !busy_);
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
