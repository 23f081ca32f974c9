// Whose a key is: the window's commands are plain letters, and lists know letters too.
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QTabWidget>
#include <QTableWidget>

#include "reading.h"
#include "vicon/core/file.h"

namespace vicon::viewer {
namespace {

using test::Reading;

/// As the window system does it: to whoever has the keyboard.
void type(int key, Qt::KeyboardModifiers modifiers = {})
{
    QTest::keyClick(QApplication::focusWidget(), Qt::Key(key), modifiers);
}

TEST_F(Reading, KeysThatAListUnderstandsBelongToTheListThatHasTheKeyboard)
{
    openCase();
    the<QDoubleSpinBox>("station")->setValue(100);
    press(window(), "jump");
    ASSERT_TRUE(eventually([] { return std::abs(station() - 100) < 2; }));
    auto* peel = the<QComboBox>("peel");
    peel->setFocus();
    type(Qt::Key_End);
    EXPECT_EQ(peel->currentIndex(), peel->count() - 1);
    type(Qt::Key_F);
    EXPECT_EQ(peel->currentData().toString(), "fat");
    type(Qt::Key_Home);
    EXPECT_EQ(peel->currentIndex(), 0);
    settle();
    EXPECT_NEAR(station(), 100, 2);
    EXPECT_EQ(the<QComboBox>("mode")->currentIndex(), 0) << "F is free flight only where no list has the keyboard";
    QTest::keyClick(the<QWidget>("endoscopic"), Qt::Key_End);
    EXPECT_TRUE(eventually([] { return length() - station() < 2; }));
}

TEST_F(Reading, TheMouseLeavesTheKeyboardInThePictureAndSoDoesANumber)
{
    openCase();
    EXPECT_EQ(QApplication::focusWidget(), the<QWidget>("endoscopic"));
    click("endoscopic", middle("endoscopic") + QPoint(60, 90), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    clickRow(markers(), 0);
    press(window(), "stepOn");
    EXPECT_EQ(QApplication::focusWidget(), the<QWidget>("endoscopic"));
    // A table that was reached by Tab moves by the arrows; the commands act on its lines.
    markers()->setFocus();
    type(Qt::Key_G);
    EXPECT_EQ(the<QComboBox>("mode")->currentText(), "guided");
    const double before = station();
    QTest::keyPress(QApplication::focusWidget(), Qt::Key_W);
    EXPECT_TRUE(eventually([&] { return station() > before + 5; })) << "steered, not searched for in the table";
    QTest::keyRelease(QApplication::focusWidget(), Qt::Key_W);
    auto* spin = the<QDoubleSpinBox>("station");
    spin->setFocus();
    spin->selectAll();
    QTest::keyClicks(spin, "50");
    type(Qt::Key_Return);
    EXPECT_TRUE(eventually([] { return std::abs(station() - 50) < 2; })) << "Return jumps";
    EXPECT_TRUE(eventually([] { return QApplication::focusWidget() == the<QWidget>("endoscopic"); }));
}

TEST_F(Reading, TheListOfKeysFitsOnALowScreen)
{
    openCase();
    key(Qt::Key_Question);
    auto* box = the<QMessageBox>("keys");
    ASSERT_TRUE(eventually([&] { return box->isVisible(); }));
    constexpr int kLowScreen_px = 650;  // 1300 pixels of twice the usual density
    EXPECT_LT(box->height(), kLowScreen_px);
    for (const char* some : {"Ctrl+M", "F2", "Del", "Home", "arrows"})
        EXPECT_TRUE(box->text().contains(some)) << some;
    box->close();
}

TEST_F(Reading, AnotherOrganAndItsEndsAreCalledByTheirNames)
{
    const auto file = store_ / "cases" / test::kCase / test::kSupine / "scan.json";
    auto scan = nlohmann::json::parse(readFile(file));
    scan["organ"] = "airway";
    replaceFile(file, scan.dump());
    openCase();
    EXPECT_TRUE(the<QLabel>("where")->text().contains("mm from the root (0 %)"))
        << the<QLabel>("where")->text().toStdString();
    EXPECT_EQ(the<QPushButton>("about")->text(), "To tip");
    EXPECT_EQ(markers()->horizontalHeaderItem(2)->toolTip(), "Distance from the root along the airway");
    EXPECT_FALSE(the<QTabWidget>("lists")->isTabEnabled(2)) << "corrections are a colon's";
    auto* scans = the<QComboBox>("scan");  // the other scan is a colon
    scans->setFocus();
    the<QLabel>("where")->clear();
    QTest::keyClick(scans, Qt::Key_Down);
    waitForScan();
    EXPECT_EQ(the<QPushButton>("about")->text(), "To caecum");
    EXPECT_TRUE(the<QTabWidget>("lists")->isTabEnabled(2));
}

}  // namespace
}  // namespace vicon::viewer
