// A reading without a mouse: every key goes to whoever has the keyboard, as the window system does it.
#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAccessible>
#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QFocusFrame>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QTabWidget>
#include <QTableWidget>
#include <algorithm>
#include <set>

#include "reading.h"

namespace vicon::viewer {
namespace {

using test::activate;
using test::Reading;
using test::type;

bool isControl(const QWidget* widget)
{
    return qobject_cast<const QAbstractButton*>(widget) || qobject_cast<const QAbstractItemView*>(widget) ||
           qobject_cast<const QAbstractSlider*>(widget) || qobject_cast<const QAbstractSpinBox*>(widget) ||
           qobject_cast<const QComboBox*>(widget) || qobject_cast<const QTabBar*>(widget) ||
           qobject_cast<const QLineEdit*>(widget) || widget->inherits("vicon::viewer::PictureView");
}

/// Parts of a control that Qt makes for itself are reached through it.
bool isOfAnother(const QWidget* widget)
{
    for (const QWidget* p = widget->parentWidget(); p && !p->isWindow(); p = p->parentWidget())
        if (qobject_cast<const QAbstractItemView*>(p) || qobject_cast<const QAbstractSpinBox*>(p) ||
            qobject_cast<const QComboBox*>(p) || qobject_cast<const QLineEdit*>(p) || qobject_cast<const QTabBar*>(p) ||
            qobject_cast<const QMenuBar*>(p))
            return true;
    return widget->inherits("QScrollBar");
}

std::vector<QWidget*> controlsOf(QWidget* window)
{
    std::vector<QWidget*> controls;
    for (QWidget* widget : window->findChildren<QWidget*>())
        if (widget->window() == window && isControl(widget) && !isOfAnother(widget))
            controls.push_back(widget);
    return controls;
}

std::string nameOf(const QWidget* widget)
{
    return (QString(widget->metaObject()->className()) + " '" + widget->objectName() + "'").toStdString();
}

void expectNames(QWidget* window)
{
    for (QWidget* control : controlsOf(window)) {
        const auto* spoken = QAccessible::queryAccessibleInterface(control);
        ASSERT_NE(spoken, nullptr) << nameOf(control);
        EXPECT_FALSE(spoken->text(QAccessible::Name).isEmpty()) << nameOf(control);
    }
}

/// All that Tab leads to, from who has the keyboard until it is there again.
std::vector<QWidget*> walkByTab()
{
    std::vector<QWidget*> way;
    QWidget* const first = QApplication::focusWidget();
    constexpr std::size_t kMost = 200;
    do {
        way.push_back(QApplication::focusWidget());
        type(Qt::Key_Tab);
    } while (QApplication::focusWidget() != first && way.size() < kMost);
    return way;
}

void expectAllReached(QWidget* window)
{
    const std::vector<QWidget*> way = walkByTab();
    const std::set<QWidget*> reached(way.begin(), way.end());
    EXPECT_EQ(reached.size(), way.size()) << "nobody comes twice";
    for (QWidget* control : controlsOf(window))
        EXPECT_TRUE(reached.count(control) || !control->isVisible() || !control->isEnabled()) << nameOf(control);
    type(Qt::Key_Backtab);
    EXPECT_EQ(QApplication::focusWidget(), way.back()) << "and back again";
    type(Qt::Key_Tab);
}

TEST_F(Reading, EveryControlHasAnAccessibleName)
{
    expectNames(room_.get());
    openCase();
    expectNames(window());
    type(Qt::Key_Question);
    expectNames(the<QDialog>("keys"));
    the<QDialog>("keys")->close();
}

TEST_F(Reading, TabLeadsToEveryControlInTheOrderOfTheEye)
{
    activate(room_.get(), room_->findChild<QLineEdit*>("search"));
    expectAllReached(room_.get());
    openCase();
    click("endoscopic", middle("endoscopic") + QPoint(60, 90), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    for (const int list : {0, 1, 2}) {
        the<QTabWidget>("lists")->setCurrentIndex(list);
        the<QWidget>("endoscopic")->setFocus();
        expectAllReached(window());
        QPoint before(-1, -1);
        for (const char* name : {"endoscopic", "axial", "overview", "mode", "lists", "peel"}) {
            QWidget* part = the<QWidget>(name);
            const QPoint at = part->mapTo(window(), QPoint(0, 0));
            EXPECT_TRUE(at.x() > before.x() || at.y() > before.y()) << name;
            before = at;
        }
    }
    const auto follows = [](const char* name) {
        type(Qt::Key_Tab);
        return QApplication::focusWidget() == the<QWidget>(name);
    };
    the<QTabWidget>("lists")->setCurrentIndex(0);
    the<QWidget>("endoscopic")->setFocus();
    for (const char* name : {"axial", "coronal", "sagittal", "overview", "mode", "back", "stop", "forward"})
        EXPECT_TRUE(follows(name)) << name;
}

/// All four sides of it, outside of the control.
bool hasWholeFrame(QWidget* control)
{
    control->setFocus(Qt::TabFocusReason);
    QCoreApplication::processEvents();  // the frame follows the control through its layout
    for (QFocusFrame* frame : control->window()->findChildren<QFocusFrame*>("focusRing"))
        if (frame->widget() == control && frame->isVisible())
            return frame->visibleRegion().boundingRect() == frame->rect() && frame->width() > control->width() &&
                   frame->height() > control->height();
    return false;
}

TEST_F(Reading, WhatHasTheKeyboardHasABrightFrame)
{
    openCase();
    ASSERT_EQ(QApplication::focusWidget(), the<QWidget>("endoscopic"));
    for (QWidget* control : walkByTab()) {
        if (!control->inherits("vicon::viewer::PictureView")) {
            EXPECT_TRUE(hasWholeFrame(control)) << nameOf(control);
            continue;
        }
        control->setFocus(Qt::TabFocusReason);
        const QColor edge = control->grab().toImage().pixelColor(control->width() / 2, 0);
        EXPECT_TRUE(edge.red() > 200 && edge.green() > 150 && edge.blue() < 100) << nameOf(control);
    }
    screenshot("focus");
    click("endoscopic", middle("endoscopic"));
    EXPECT_EQ(QApplication::focusWidget(), the<QWidget>("endoscopic"));
    EXPECT_LT(pictureOf("endoscopic").pixelColor(the<QWidget>("endoscopic")->width() / 2, 0).green(), 150)
        << "a mouse has no need of it";
    type(Qt::Key_Question);
    auto* box = the<QDialog>("keys");
    ASSERT_TRUE(eventually([&] { return box->isActiveWindow(); }));
    EXPECT_TRUE(hasWholeFrame(box->findChild<QPushButton*>()));
    box->close();
}

/// A reader who has no mouse, with a case open.
class WithoutMouse : public Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        auto* search = room_->findChild<QLineEdit*>("search");
        activate(room_.get(), search);
        QTest::keyClicks(search, "anna");
        type(Qt::Key_Escape);
        ASSERT_EQ(QApplication::focusWidget(), cases()) << "Escape leaves the text";
        type(Qt::Key_Return);
        ASSERT_TRUE(eventually([] { return window() != nullptr; }));
        waitForScan();
    }

    static bool has(int count)
    {
        return eventually([&] { return markers()->rowCount() == count && settled(); });
    }
    /// With J.
    static bool jump(const char* mm)
    {
        type(Qt::Key_J);
        QTest::keyClicks(QApplication::focusWidget(), mm);
        type(Qt::Key_Return);
        return eventually([&] { return std::abs(station() - atof(mm)) < 2 && pictureIsThere(); });
    }
    /// At 150 mm, beside the middle of the view.
    static bool mark()
    {
        const bool there = jump("150");
        type(Qt::Key_1);
        type(Qt::Key_Right);
        type(Qt::Key_Down);
        type(Qt::Key_Return);
        return there && has(1);
    }
    Marker first() const
    {
        const auto all = stored();
        return all.empty() ? Marker{} : all[0];
    }
    static void times(int count, Qt::Key key)
    {
        for (int n = 0; n < count; ++n)
            type(key);
    }
};

TEST_F(WithoutMouse, FliesAndJumps)
{
    type(Qt::Key_Space);
    ASSERT_TRUE(eventually([] { return station() > 20; }));
    type(Qt::Key_Space);
    ASSERT_TRUE(jump("150"));
    type(Qt::Key_J);
    QTest::keyClicks(QApplication::focusWidget(), "50");
    type(Qt::Key_Escape);
    waitUntilQuiet();
    EXPECT_EQ(QApplication::focusWidget(), the<QWidget>("endoscopic"));
    EXPECT_NEAR(station(), 150, 2) << "not used";
    EXPECT_NEAR(the<QDoubleSpinBox>("station")->value(), 150, 2);
}

TEST_F(WithoutMouse, MarksWithACrossInThePicturesAndInASlice)
{
    ASSERT_TRUE(jump("150"));
    type(Qt::Key_1);
    type(Qt::Key_Right);
    type(Qt::Key_Down);
    screenshot("cross");
    type(Qt::Key_Return);
    ASSERT_TRUE(has(1)) << warning();
    type(Qt::Key_2);
    times(8, Qt::Key_Left);
    type(Qt::Key_Return);
    ASSERT_TRUE(has(2));
    EXPECT_GT(distance(stored()[0].position_mm, stored()[1].position_mm), 5) << "the cross was moved";
    type(Qt::Key_Return, Qt::ShiftModifier);
    ASSERT_TRUE(has(3)) << "at once";
    type(Qt::Key_Tab);
    ASSERT_EQ(QApplication::focusWidget(), the<QWidget>("axial"));
    const QImage before = pictureOf("axial");
    type(Qt::Key_PageUp);
    EXPECT_TRUE(eventually([&] { return pictureOf("axial") != before; })) << "scrolled";
    type(Qt::Key_3);
    type(Qt::Key_Up, Qt::ShiftModifier);
    type(Qt::Key_Return);
    ASSERT_TRUE(has(4));
    EXPECT_EQ(stored()[3].color, MarkerColor::green);
}

TEST_F(WithoutMouse, ChoosesInTheListAndWritesNotes)
{
    ASSERT_TRUE(mark()) << warning();
    type(Qt::Key_Home);
    ASSERT_TRUE(eventually([] { return station() < 2; }));
    type(Qt::Key_L);
    ASSERT_EQ(QApplication::focusWidget(), markers());
    type(Qt::Key_Return);
    EXPECT_TRUE(eventually([] { return station() > 120; })) << "flown to";
    type(Qt::Key_N);
    QTest::keyClicks(QApplication::focusWidget(), "sessile");
    type(Qt::Key_Return);
    ASSERT_TRUE(eventually([&] { return first().note == "sessile" && settled(); }));
    EXPECT_EQ(QApplication::focusWidget(), markers());
    type(Qt::Key_N);
    QTest::keyClicks(QApplication::focusWidget(), "not meant");
    type(Qt::Key_Escape);
    EXPECT_EQ(cell(0, 6), "sessile");
    type(Qt::Key_Escape);
    EXPECT_EQ(QApplication::focusWidget(), the<QWidget>("endoscopic"));
}

TEST_F(WithoutMouse, MeasuresCirclesAndMoves)
{
    ASSERT_TRUE(mark()) << warning();
    const auto anyHas = [&](const char* what) {
        const auto all = stored();
        return settled() &&
               std::any_of(all.begin(), all.end(), [&](const Marker& m) { return toJson(m).contains(what); });
    };
    type(Qt::Key_L);
    type(Qt::Key_Return);
    ASSERT_TRUE(eventually([] { return pictureIsThere(); }));
    type(Qt::Key_M);
    ASSERT_EQ(QApplication::focusWidget(), the<QWidget>("endoscopic"));
    type(Qt::Key_Return);
    times(8, Qt::Key_Right);  // more than a voxel
    type(Qt::Key_Return);
    EXPECT_TRUE(eventually([&] { return anyHas("size"); })) << warning();
    type(Qt::Key_T);
    type(Qt::Key_Return);
    times(16, Qt::Key_Right);
    type(Qt::Key_Return);
    EXPECT_TRUE(eventually([&] { return anyHas("density"); })) << warning();
    type(Qt::Key_Escape);
    const Point3 was = first().position_mm;
    the<QWidget>("markerMove")->setFocus(Qt::TabFocusReason);
    type(Qt::Key_Space);
    ASSERT_EQ(QApplication::focusWidget(), the<QWidget>("endoscopic"));
    times(4, Qt::Key_Up);
    type(Qt::Key_Return);
    EXPECT_TRUE(eventually([&] { return !(first().position_mm == was) && settled(); })) << warning();
}

TEST_F(WithoutMouse, PeelsSeesOneViewAloneAndCloses)
{
    const QImage plain = pictureOf("endoscopic");
    the<QWidget>("peel")->setFocus(Qt::TabFocusReason);
    type(Qt::Key_Down);
    EXPECT_TRUE(eventually([&] { return pictureOf("endoscopic") != plain; }));
    type(Qt::Key_Up);
    type(Qt::Key_Escape);
    type(Qt::Key_E);
    EXPECT_FALSE(the<QWidget>("coronal")->isVisible());
    type(Qt::Key_E);
    EXPECT_TRUE(the<QWidget>("coronal")->isVisible());
    type(Qt::Key_W, Qt::ControlModifier);
    EXPECT_TRUE(eventually([] { return window() == nullptr; }));
}

TEST_F(Reading, TheListOfKeysNamesEveryKeyAndNoneTwice)
{
    openCase();
    type(Qt::Key_Question);
    auto* box = the<QDialog>("keys");
    const QString listed = box->findChild<QLabel*>("keysText")->text().replace("&nbsp;", " ");
    std::set<QString> seen;
    for (const QMenu* menu : window()->menuBar()->findChildren<QMenu*>())
        for (const QAction* action : menu->actions()) {
            const QString key = action->shortcut().toString();
            if (key.isEmpty())
                continue;
            EXPECT_TRUE(seen.insert(key).second) << key.toStdString();
            EXPECT_TRUE(listed.contains("<b>" + key.toHtmlEscaped() + "</b>")) << key.toStdString();
            EXPECT_TRUE(listed.contains(action->text().remove('&').toHtmlEscaped())) << key.toStdString();
        }
    for (const char* other : {"W A S D", "arrows, Return", "Shift+Return", "Tab, Shift+Tab", "PgUp, PgDown"})
        EXPECT_TRUE(listed.contains(QString("<b>%1</b>").arg(other))) << other;
    QTest::keyClick(box, Qt::Key_Escape);
    EXPECT_TRUE(eventually([&] { return window()->findChild<QDialog*>("keys") == nullptr; }));
}

}  // namespace
}  // namespace vicon::viewer
