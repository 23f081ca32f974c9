#pragma once

#include <gtest/gtest.h>

#include <QApplication>
#include <QMainWindow>
#include <QtTest/QTest>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "reading_store.h"
#include "vicon/support/support.h"
#include "vicon/viewer/scene/display.h"

class QTableWidget;

namespace vicon::viewer::test {

/// As the window system does it: to whoever has the keyboard.
inline void type(int key, Qt::KeyboardModifiers modifiers = {})
{
    ASSERT_NE(QApplication::focusWidget(), nullptr) << "nobody has the keyboard";
    QTest::keyClick(QApplication::focusWidget(), Qt::Key(key), modifiers);
}

/// Before the first key, as a window manager does it.
inline void activate(QWidget* window, QWidget* focus)
{
    window->activateWindow();
    focus->setFocus();
    ASSERT_TRUE(QTest::qWaitFor([&] { return QApplication::focusWidget() == focus; }));
}

/// One reader at the screen: looks for controls by name, presses, waits until what must follow is there. The screen is
/// shared by the tests of a program; pictures of each step stay in the build tree.
class Reader : public testing::Test {
protected:
    static void SetUpTestSuite();
    static void TearDownTestSuite();
    void TearDown() override { room_.reset(); }

    void openRoom(const ReadingServices& services, const std::string& case_id = {});
    /// Chooses a line of the worklist by the patient's ID and opens it; waits until its pictures are there.
    void openCase(const char* patient_id = "PH-1");
    /// Presses Open for that patient, and waits for nothing.
    void startOpening(const char* patient_id = "PH-1");
    static void waitForScan();
    /// The same while work goes on that has no end yet: the pictures are there, and others may follow.
    static void waitForPictures();
    /// The next scan of the list is opened, by the keyboard.
    static void openOther();
    /// Until its window is gone.
    static void closeCase();

    template <class Condition>
    static bool eventually(Condition condition)
    {
        return QTest::qWaitFor(condition, patience_ms);
    }
    /// All that the windows of the program began is shown: no work waits for another thread, runs there or is still to
    /// be shown, no smooth drawing waits until the eye rests, and no event waits, of the window system neither. What is
    /// looked for every few seconds (the worklist, other readers' markers) may still come.
    static bool quiet();
    /// When it is quiet, what must not come (a picture of an older place, a second list) has not come.
    static void waitUntilQuiet();
    /// Pictures drawn one after the other are of the same millimetre: a drift that fades is nil only much later.
    static void waitUntilAtRest();

    QTableWidget* cases() const;
    static QMainWindow* window();
    template <class T>
    static T* the(const char* name)
    {
        T* found = window()->findChild<T*>(name);
        EXPECT_NE(found, nullptr) << name;
        return found;
    }
    static void press(QWidget* in, const char* name);
    static void click(const char* view, QPoint at, Qt::KeyboardModifiers modifiers = {});
    /// In four moves.
    static void drag(const char* view, QPoint from, QPoint to, Qt::MouseButton button = Qt::LeftButton);
    static void key(int which, Qt::KeyboardModifiers modifiers = {});
    static QPoint middle(const char* view);
    /// The list of markers, of what was not seen, of the bridges: 0, 1, 2.
    static void showList(int which);
    static QTableWidget* markers();
    static void clickRow(QTableWidget* table, int row, int column = 0);
    /// Nothing is on its way to the database.
    static bool settled();
    static QString cell(int row, int column);
    static std::string warning();
    /// The line at the window's foot.
    static QString said();
    /// The report's pages, which are drawn on another thread: there is ink on the paper.
    static bool pagesAreDrawn(const QWidget* preview);
    /// Answers a dialog for files.
    static void chooseFile(const char* dialog, const QString& file);

    /// More than text: the colours of its middle differ.
    static bool drawn(const char* view);
    static QImage pictureOf(const char* view);
    /// The endoscopic picture is that of the place where the eye is: a click means what the picture shows.
    static bool pictureIsThere();
    static double pictureStation();
    static double station();
    static double length();
    void screenshot(const char* name) const;
    /// As it looks at this moment: while the eye moves, or a peeled picture that nobody looks at is still to come.
    void screenshotNow(const char* name) const;
    std::vector<Marker> stored(const char* case_id = kCase) const;

    static inline int patience_ms = 60000;  // a still peeled picture takes 20 s under the sanitizers, on a busy machine
    static std::unique_ptr<Display> display_;
    static std::unique_ptr<support::TemporaryFolder> folder_;
    static std::unique_ptr<QApplication> application_;
    std::filesystem::path store_;
    std::unique_ptr<QWidget> room_;
};

/// With the worklist open on a store of its own: a case of two scans of a colon of closed form, and one that failed.
class Reading : public Reader {
protected:
    void SetUp() override;

    ReadingServices services_;
};

}  // namespace vicon::viewer::test
