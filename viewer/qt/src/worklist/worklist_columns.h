#pragma once

#include <QString>

#include "vicon/cases/worklist.h"

class QTableWidget;
class QWidget;

namespace vicon::viewer {

/// The table of cases, without lines. Its columns stand in worklist_columns.cpp, a line each.
QTableWidget* makeCaseTable(QWidget* parent);

/// Fills a line; returns whether it says something else than before.
bool fillLine(QTableWidget& table, int line, const WorklistCase& row);

/// Makes each column as wide as what it holds; the patient's name takes the rest.
void fitColumns(QTableWidget& table);

/// A line a scan: how well it is distended, or what is wrong with it.
QString wordsOf(const WorklistCase& row, bool with_reasons);

/// Whether any of its scans can be read, others may still be in work.
bool readable(const WorklistCase& row);

/// Whether any of its scans was spoiled by corrections.
bool spoiled(const WorklistCase& row);

}  // namespace vicon::viewer
