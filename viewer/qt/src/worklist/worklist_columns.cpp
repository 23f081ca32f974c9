#include "worklist/worklist_columns.h"

#include <QCoreApplication>
#include <QHeaderView>
#include <QTableWidget>
#include <algorithm>

#include "vicon/cases/printed.h"
#include "widgets/case_flags.h"

namespace vicon::viewer {
namespace {

QString cellText(const std::string& utf8)
{
    return QString::fromStdString(utf8);
}

QString scansOf(const WorklistCase& row)
{
    QStringList names;
    for (const WorklistScan& scan : row.scans)
        if (scan.state != WorkState::kept && scan.state != WorkState::refused)
            names << cellText(positionName(scan.record.series.patient_position) +
                              (scan.organ.isColon() ? "" : " (" + scan.organ.name() + ")"));
    return names.join(", ");
}

/// Enough to choose the next case by; the tooltip says it of each scan.
QString qualityOf(const WorklistCase& row)
{
    QStringList inadequate;
    bool known = false;
    for (const WorklistScan& scan : row.scans) {
        if (scan.spoiled())
            continue;  // what is known of it is of another lumen
        known = known || !scan.quality.empty();
        if (!scan.quality.empty() && !scan.adequate)
            inadequate << cellText(positionName(scan.record.series.patient_position));
    }
    if (!known)
        return {};
    return inadequate.empty()
               ? QCoreApplication::translate("WorklistWindow", "adequate")
               : QCoreApplication::translate("WorklistWindow", "not adequate: %1").arg(inadequate.join(", "));
}

QString progressOf(const WorklistCase& row)
{
    for (const WorklistScan& scan : row.scans)
        if (scan.state == WorkState::running)
            return QString("%1 %, %2").arg(100 * row.progress, 0, 'f', 0).arg(cellText(scan.step));
    return QString("%1 %").arg(100 * row.progress, 0, 'f', 0);
}

/// What the list shows of a case. A new column is a line here.
struct WorklistColumn {
    const char* title;
    QString (*cell)(const WorklistCase&);
    QString (*tip)(const WorklistCase&) = nullptr;  ///< where the cell cannot say all
};

QString patientOf(const WorklistCase& row)
{
    return cellText(printedPatientName(row.record.patient.name));
}

const WorklistColumn kWorklistColumns[] = {
    {QT_TRANSLATE_NOOP("WorklistWindow", "Patient"), patientOf, patientOf},  // a long name is cut off in its cell
    {QT_TRANSLATE_NOOP("WorklistWindow", "ID"),
     [](const WorklistCase& row) { return cellText(row.record.patient.id); }},
    {QT_TRANSLATE_NOOP("WorklistWindow", "Study date"),
     [](const WorklistCase& row) { return cellText(printedDate(row.record.study.date)); }},
    {QT_TRANSLATE_NOOP("WorklistWindow", "Scans"), scansOf},
    {QT_TRANSLATE_NOOP("WorklistWindow", "State"),
     [](const WorklistCase& row) { return cellText(nameOf(row.state) + (row.record.flags.empty() ? "" : " !")); },
     [](const WorklistCase& row) { return flagsOf(row.record); }},
    {QT_TRANSLATE_NOOP("WorklistWindow", "Progress"), progressOf},
    {QT_TRANSLATE_NOOP("WorklistWindow", "Quality"), qualityOf,
     [](const WorklistCase& row) { return wordsOf(row, false); }},
    {QT_TRANSLATE_NOOP("WorklistWindow", "Markers"),
     [](const WorklistCase& row) { return QString::number(row.markers); }},
    {QT_TRANSLATE_NOOP("WorklistWindow", "Reports"),
     [](const WorklistCase& row) { return QString::number(row.reports); }},
};
constexpr int kPatient = 0;

}  // namespace

QTableWidget* makeCaseTable(QWidget* parent)
{
    auto* table = new QTableWidget(0, int(std::size(kWorklistColumns)), parent);
    table->setObjectName("cases");
    table->setAccessibleName(QCoreApplication::translate("WorklistWindow", "Cases"));
    QStringList titles;
    for (const WorklistColumn& column : kWorklistColumns)
        titles << QCoreApplication::translate("WorklistWindow", column.title);
    table->setHorizontalHeaderLabels(titles);
    table->setSelectionBehavior(QAbstractItemView::SelectRows);
    table->setSelectionMode(QAbstractItemView::SingleSelection);
    table->setTabKeyNavigation(false);  // Tab leads out of it; the arrow keys move in it
    table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table->setAlternatingRowColors(true);
    table->verticalHeader()->hide();
    table->horizontalHeader()->setSectionResizeMode(kPatient, QHeaderView::Stretch);
    return table;
}

bool fillLine(QTableWidget& table, int line, const WorklistCase& row)
{
    bool changed = false;
    for (int column = 0; column < int(std::size(kWorklistColumns)); ++column) {
        if (!table.item(line, column))
            table.setItem(line, column, new QTableWidgetItem);
        QTableWidgetItem& item = *table.item(line, column);
        const QString cell = kWorklistColumns[column].cell(row);
        changed = changed || item.text() != cell;
        item.setText(cell);
        if (kWorklistColumns[column].tip)
            item.setToolTip(kWorklistColumns[column].tip(row));
    }
    return changed;
}

void fitColumns(QTableWidget& table)
{
    for (int column = kPatient + 1; column < table.columnCount(); ++column)
        table.resizeColumnToContents(column);
}

QString wordsOf(const WorklistCase& row, bool with_reasons)
{
    QStringList lines;
    if (with_reasons && !row.record.flags.empty())
        lines << flagsOf(row.record);
    for (const WorklistScan& scan : row.scans) {
        const std::string& words = with_reasons && !scan.reason.empty() ? scan.reason : scan.quality;
        if (!words.empty())
            lines << cellText(positionName(scan.record.series.patient_position) + ": " + words) +
                         (with_reasons && scan.spoiled()
                              ? QCoreApplication::translate("WorklistWindow",
                                                            " (corrected; Retry forgets its corrections)")
                              : QString());
    }
    return lines.join("\n");
}

bool readable(const WorklistCase& row)
{
    return std::any_of(row.scans.begin(), row.scans.end(), [](const WorklistScan& s) { return s.ready(); });
}

bool spoiled(const WorklistCase& row)
{
    return std::any_of(row.scans.begin(), row.scans.end(), [](const WorklistScan& s) { return s.spoiled(); });
}

}  // namespace vicon::viewer
