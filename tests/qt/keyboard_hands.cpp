// A reader who never touches the mouse.
#include <QAction>
#include <QPushButton>
#include <QTabWidget>
#include <QTableWidget>

#include "whole_reading.h"

namespace vicon::viewer::test {

void ByKeyboard::openFirst()
{
    activate(room_.get(), cases());
    type(Qt::Key_Return);
}

void ByKeyboard::command(const QString& entry)
{
    const QAction* action = actionOf(entry);
    ASSERT_NE(action, nullptr) << entry.toStdString();
    const QKeySequence key = action->shortcut();
    ASSERT_EQ(key.count(), 1) << entry.toStdString() << " has no key";
    const int modifiers = key[0] & int(Qt::KeyboardModifierMask);
    type(key[0] & ~int(Qt::KeyboardModifierMask), Qt::KeyboardModifiers(modifiers));
}

void ByKeyboard::tabTo(const char* name)
{
    constexpr int kMost = 120;
    for (int n = 0; n < kMost && QApplication::focusWidget()->objectName() != name; ++n)
        type(Qt::Key_Tab);
    ASSERT_EQ(QApplication::focusWidget()->objectName().toStdString(), name);
}

void ByKeyboard::pick(const char* view, const std::vector<QPoint>& by)
{
    constexpr int kStep_px = 8;
    ASSERT_NO_FATAL_FAILURE(tabTo(view));
    QPoint at;
    for (const QPoint& next : by) {
        for (int x = at.x(); x != next.x(); x += x < next.x() ? kStep_px : -kStep_px)
            type(x < next.x() ? Qt::Key_Right : Qt::Key_Left);
        for (int y = at.y(); y != next.y(); y += y < next.y() ? kStep_px : -kStep_px)
            type(y < next.y() ? Qt::Key_Down : Qt::Key_Up);
        type(Qt::Key_Return);
        at = next;
    }
}

void ByKeyboard::scroll(const char* view, int steps)
{
    ASSERT_EQ(QApplication::focusWidget()->objectName(), view);
    for (int n = 0; n < std::abs(steps); ++n)
        type(steps > 0 ? Qt::Key_PageUp : Qt::Key_PageDown);
}

void ByKeyboard::goTo(double station_mm)
{
    type(Qt::Key_J);
    QTest::keyClicks(QApplication::focusWidget(), QString::number(station_mm, 'f', 0));
    type(Qt::Key_Return);
    ASSERT_TRUE(eventually([&] { return std::abs(station() - station_mm) < 2 && pictureIsThere(); })) << station();
}

void ByKeyboard::pressButton(const char* name)
{
    const QString title = the<QPushButton>(name)->text();
    const int mark = title.indexOf('&');
    if (mark >= 0) {
        type(title[mark + 1].toUpper().unicode(), Qt::AltModifier);
        return;
    }
    ASSERT_NO_FATAL_FAILURE(tabTo(name));
    type(Qt::Key_Space);
}

/// L goes to the list, and once more to the next one.
void ByKeyboard::chooseLine(int list, const char* table, int row)
{
    auto* lists = the<QTabWidget>("lists");
    type(Qt::Key_L);
    for (int n = 0; n < lists->count() && lists->currentIndex() != list; ++n)
        type(Qt::Key_L);
    ASSERT_EQ(lists->currentIndex(), list);
    auto* lines = the<QTableWidget>(table);
    ASSERT_TRUE(eventually([&] { return lines->rowCount() > row && lines->isEnabled() && lines->hasFocus(); }));
    while (lines->currentRow() != row)
        type(lines->currentRow() < row ? Qt::Key_Down : Qt::Key_Up);
    type(Qt::Key_Return);
}

void ByKeyboard::choose(const char* choice, int entry)
{
    ASSERT_NO_FATAL_FAILURE(tabTo(choice));
    for (int n = 0; n < entry; ++n)
        type(Qt::Key_Down);
}

void ByKeyboard::sayNumber(const char* field, int value)
{
    ASSERT_NO_FATAL_FAILURE(tabTo(field));
    QTest::keyClicks(QApplication::focusWidget(), QString::number(value));
    type(Qt::Key_Tab);
}

void ByKeyboard::sign(QWidget* question)
{
    QTest::keyClick(question, Qt::Key_Return);
}

void ByKeyboard::leafThrough(QWidget* pages)
{
    activate(pages, pages->findChild<QWidget*>("reportPages"));
    for (int n = 0; n < 2; ++n)
        type(Qt::Key_PageDown);
    type(Qt::Key_Escape);
}

}  // namespace vicon::viewer::test
