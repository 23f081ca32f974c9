#pragma once

#include <vector>

class QWidget;
class QPushButton;
class QTableWidget;

namespace vicon::viewer {

/// The controls in `part`, itself among them, that Tab leads to, in the order in which they were made.
std::vector<QWidget*> reachableIn(QWidget* part);

/// A list beside the views: its lines are chosen as a whole, one at a time, and are as low as their text, for the
/// panels share the height of one screen. It never shows fewer than `least_rows`.
void setUpList(QTableWidget* table, int least_rows);

/// May be as narrow as its title, so that a panel's buttons stand in one row.
void tighten(QPushButton* button);

}  // namespace vicon::viewer
