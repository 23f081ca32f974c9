// Whose a key is: the window's commands are plain letters, and lists know letters too.
#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QTabWidget>
#include <QTableWidget>

#include "reading.h"
#include "vicon/scan_files/skeleton_file.h"

namespace vicon::viewer {
namespace {

using test::Reading;
using test::type;

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
    waitUntilQuiet();
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

TEST_F(Reading, TheKeyThatGoesToTheListGoesOnToTheNextOneThatCanBeUsed)
{
    openCase();
    auto* lists = the<QTabWidget>("lists");
    lists->setTabEnabled(2, false);
    std::vector<int> shown;
    for (int n = 0; n <= lists->count(); ++n) {
        type(Qt::Key_L);
        shown.push_back(lists->currentIndex());
        EXPECT_TRUE(lists->currentWidget()->isAncestorOf(QApplication::focusWidget())) << shown.back();
    }
    EXPECT_EQ(shown, (std::vector<int>{0, 1, 3, 4, 0, 1}));
    key(Qt::Key_Escape);
    type(Qt::Key_L);
    EXPECT_EQ(lists->currentIndex(), 1) << "back to where the reader was";
}

TEST_F(Reading, TheListOfKeysFitsOnALowScreen)
{
    openCase();
    key(Qt::Key_Question);
    auto* box = the<QDialog>("keys");
    ASSERT_TRUE(eventually([&] { return box->isVisible(); }));
    constexpr int kLowScreen_px = 650;  // 1300 pixels of twice the usual density
    EXPECT_LT(box->height(), kLowScreen_px);
    for (const char* some : {"Ctrl+M", "F2", "Del", "Home", "arrows"})
        EXPECT_TRUE(the<QLabel>("keysText")->text().contains(some)) << some;
    box->close();
}

TEST_F(Reading, AnotherOrganAndItsEndsAreCalledByTheirNames)
{
    test::sayOrgan(store_ / "cases" / test::kCase / test::kSupine, "airway");
    openCase();
    EXPECT_TRUE(the<QLabel>("where")->text().contains("mm from the root (0 %)"))
        << the<QLabel>("where")->text().toStdString();
    EXPECT_EQ(the<QPushButton>("about")->text(), "Heading: tip");
    EXPECT_EQ(markers()->horizontalHeaderItem(2)->toolTip(), "Distance from the root along the airway");
    EXPECT_FALSE(the<QTabWidget>("lists")->isTabEnabled(2)) << "corrections are a colon's";
    auto* windows = the<QComboBox>("window");
    EXPECT_EQ(windows->currentText(), "lung");
    EXPECT_EQ(windows->findText("colon"), -1);
    auto* scans = the<QComboBox>("scan");  // the other scan is a colon
    scans->setFocus();
    the<QLabel>("where")->clear();
    QTest::keyClick(scans, Qt::Key_Down);
    waitForScan();
    EXPECT_EQ(the<QPushButton>("about")->text(), "Retrograde");
    EXPECT_TRUE(the<QTabWidget>("lists")->isTabEnabled(2));
    windows->setCurrentText("soft-tissue");
    key(Qt::Key_X);
    waitForScan();
    EXPECT_EQ(windows->currentText(), "soft-tissue") << "both organs have it";
    windows->setCurrentText("bone");
    closeCase();
    openCase();
    EXPECT_EQ(the<QComboBox>("window")->currentText(), "bone");
}

/// The colon's path as a tree: a trunk, the rest of it, and a side branch beside that, which ends a little earlier.
void makeTree(const std::filesystem::path& folder)
{
    const auto points = scan_files::readSkeleton(folder / "skeleton.vtp").pieces.front().points;
    const auto fork = points.begin() + std::ptrdiff_t(points.size() / 2);
    const auto end = points.begin() + std::ptrdiff_t(points.size() * 4 / 5);
    SkeletonTree tree;
    tree.branches.push_back({-1, 0, {points.begin(), fork + 1}});
    tree.branches.push_back({0, 1, {fork, points.end()}});
    tree.branches.push_back({0, 1, {fork, end}});
    for (std::size_t n = 1; n < tree.branches[2].points.size(); ++n)
        tree.branches[2].points[n].position_mm.y += 2;
    scan_files::writeSkeletonTree(folder / "skeleton.vtp", tree);
    test::sayOrgan(folder, "airway");
}

TEST_F(Reading, TheWayToAnotherTipIsChosenInTheListOrInTheProjectionAndKept)
{
    openCase();
    EXPECT_FALSE(the<QComboBox>("way")->isVisible()) << "a colon has one way";
    closeCase();
    makeTree(store_ / "cases" / test::kCase / test::kSupine);
    openCase();
    auto* way = the<QComboBox>("way");
    ASSERT_TRUE(way->isVisible());
    ASSERT_EQ(way->count(), 2);
    EXPECT_TRUE(way->itemText(0).startsWith("to tip 1, ")) << way->itemText(0).toStdString();
    const double whole = length();
    the<QDoubleSpinBox>("station")->setValue(50);
    press(window(), "jump");
    ASSERT_TRUE(eventually([] { return std::abs(station() - 50) < 2; }));
    way->setFocus();
    type(Qt::Key_Down);
    ASSERT_TRUE(eventually([&] { return length() < 0.9 * whole; })) << warning();
    waitForScan();
    EXPECT_NEAR(station(), 50, 2) << "on the trunk that both ways share";
    screenshot("other_way");
    closeCase();
    openCase();
    EXPECT_EQ(the<QComboBox>("way")->currentData().toInt(), 2);
    EXPECT_LT(length(), 0.9 * whole);
    // The caecum's end of the test's colon, which only the other way reaches.
    auto* overview = the<QWidget>("overview");
    for (int y = overview->height() / 2; y < overview->height() * 9 / 10 && length() < 0.9 * whole; y += 8) {
        click("overview", QPoint(overview->width() * 4 / 10, y));
        waitUntilQuiet();
    }
    EXPECT_TRUE(eventually([&] { return length() > 0.95 * whole && station() > 0.8 * whole; })) << station();
    EXPECT_EQ(the<QComboBox>("way")->currentData().toInt(), 1);
}

}  // namespace
}  // namespace vicon::viewer
