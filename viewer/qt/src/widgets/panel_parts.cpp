#include "widgets/panel_parts.h"

#include <QHeaderView>
#include <QPushButton>
#include <QTableWidget>

namespace vicon::viewer {
namespace {
constexpr int kRowMargin_px = 6, kTitleMargin_px = 12;
}

void setUpList(QTableWidget* table, int least_rows)
{
    table->setSelectionBehavior(QAbstractItemView::SelectRows);
    table->setSelectionMode(QAbstractItemView::SingleSelection);
    table->setTabKeyNavigation(false);  // Tab leads out of it; the arrow keys move in it
    // A last section that is merely stretched keeps, in a table grown narrower, a width of its own.
    table->horizontalHeader()->setSectionResizeMode(table->columnCount() - 1, QHeaderView::Stretch);
    const int row_px = table->fontMetrics().height() + kRowMargin_px;
    table->verticalHeader()->hide();
    table->verticalHeader()->setMinimumSectionSize(row_px);
    table->verticalHeader()->setDefaultSectionSize(row_px);
    table->setMinimumHeight(table->horizontalHeader()->sizeHint().height() + least_rows * row_px +
                            2 * table->frameWidth());
}

std::vector<QWidget*> reachableIn(QWidget* part)
{
    std::vector<QWidget*> found;
    QList<QWidget*> all = part->findChildren<QWidget*>();
    all.prepend(part);
    for (QWidget* control : all)
        if (control->window() == part->window() && (control->focusPolicy() & Qt::TabFocus) && !control->focusProxy())
            found.push_back(control);
    return found;
}

void tighten(QPushButton* button)
{
    button->setMinimumWidth(button->fontMetrics().horizontalAdvance(button->text()) + kTitleMargin_px);
}

}  // namespace vicon::viewer
