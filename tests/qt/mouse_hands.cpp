// A reader who never touches the keyboard.
#include <QAbstractItemView>
#include <QAbstractScrollArea>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QPushButton>
#include <QStyleOptionSpinBox>
#include <QTableWidget>
#include <QWheelEvent>

#include "whole_reading.h"
#include "widgets/picture_view.h"

namespace vicon::viewer::test {
namespace {

void clickOn(QWidget* widget, QPoint at)
{
    QTest::mouseMove(widget, at);
    QTest::mouseClick(widget, Qt::LeftButton, {}, at);
}

/// Of those beside a number.
QPoint arrow(QDoubleSpinBox* of, QStyle::SubControl which)
{
    QStyleOptionSpinBox option;
    option.initFrom(of);
    option.subControls = QStyle::SC_All;
    return of->style()->subControlRect(QStyle::CC_SpinBox, &option, which, of).center();
}

}  // namespace

void ByMouse::openFirst()
{
    clickRow(cases(), 0);
    press(room_.get(), "open");
}

void ByMouse::command(const QString& entry)
{
    QAction* action = actionOf(entry);
    ASSERT_NE(action, nullptr) << entry.toStdString();
    QMenu* menu = nullptr;
    for (QWidget* widget : action->associatedWidgets())
        menu = menu ? menu : qobject_cast<QMenu*>(widget);
    ASSERT_NE(menu, nullptr) << entry.toStdString() << " is in no menu";
    auto* bar = qobject_cast<QMainWindow*>(window())->menuBar();
    clickOn(bar, bar->actionGeometry(menu->menuAction()).center());
    ASSERT_TRUE(eventually([&] { return menu->isVisible(); })) << entry.toStdString();
    EXPECT_LT(menu->height() + bar->height(), GetParam().screen.height()) << "it does not fit this screen";
    ASSERT_TRUE(action->isEnabled()) << entry.toStdString();
    clickOn(menu, menu->actionGeometry(action).center());
    ASSERT_TRUE(eventually([&] { return !menu->isVisible(); })) << entry.toStdString();
}

void ByMouse::pick(const char* view, const std::vector<QPoint>& by)
{
    const QPoint home = the<PictureView>(view)->home();
    for (const QPoint& next : by)
        clickOn(the<QWidget>(view), home + next);
}

void ByMouse::wheel(QWidget* over, int notches)
{
    constexpr int kNotch = 120;
    const QPoint at = over->rect().center();
    QWheelEvent event(at, over->mapToGlobal(at), {}, {0, kNotch * notches}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
    QApplication::sendEvent(over, &event);
}

void ByMouse::scroll(const char* view, int steps)
{
    wheel(the<QWidget>(view), steps);
}

/// By a click in the projection, which is coarse, and from there by the wheel in the view from inside.
void ByMouse::goTo(double station_mm)
{
    constexpr double kNotch_mm = 5;
    auto* overview = the<QWidget>("overview");
    const double before = station();
    clickOn(overview, overview->rect().center());
    ASSERT_TRUE(eventually([&] { return station() != before && pictureIsThere(); }));
    wheel(the<QWidget>("endoscopic"), int(std::lround((station_mm - station()) / kNotch_mm)));
    ASSERT_TRUE(eventually([&] { return std::abs(station() - station_mm) < kNotch_mm && pictureIsThere(); }))
        << station();
}

void ByMouse::pressButton(const char* name)
{
    press(window(), name);
}

void ByMouse::chooseLine(int list, const char* table, int row)
{
    showList(list);
    auto* lines = the<QTableWidget>(table);
    ASSERT_TRUE(eventually([&] { return lines->rowCount() > row && lines->isEnabled(); }));
    clickRow(lines, row);
}

void ByMouse::choose(const char* choice, int entry)
{
    auto* combo = the<QComboBox>(choice);
    clickOn(combo, combo->rect().center());
    QAbstractItemView* list = combo->view();
    ASSERT_TRUE(eventually([&] { return list->isVisible(); })) << choice;
    // The first click opened it, and a release soon after it is not meant for the list.
    EXPECT_TRUE(eventually([&] {
        if (list->isVisible())
            clickOn(list->viewport(), list->visualRect(combo->model()->index(entry, 0)).center());
        return !list->isVisible() && combo->currentIndex() == entry;
    })) << choice;
}

/// As fast as the finger can, and not waiting until each is saved.
void ByMouse::sayNumber(const char* field, int value)
{
    constexpr int kMost = 100;
    auto* number = the<QDoubleSpinBox>(field);
    for (int n = 0; n < kMost && number->value() != value; ++n)
        clickOn(number, arrow(number, number->value() < value ? QStyle::SC_SpinBoxUp : QStyle::SC_SpinBoxDown));
    EXPECT_EQ(number->value(), value);
}

void ByMouse::sign(QWidget* question)
{
    press(question, "confirmSign");
}

void ByMouse::leafThrough(QWidget* pages)
{
    wheel(pages->findChild<QAbstractScrollArea*>("reportPages")->viewport(), -8);
    auto* close = pages->findChild<QDialogButtonBox*>("reportPreviewButtons")->button(QDialogButtonBox::Close);
    QTest::mouseClick(close, Qt::LeftButton);
}

}  // namespace vicon::viewer::test
