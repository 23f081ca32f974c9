// An organ that no path leads through: flown freely, by key and mouse; what needs a path says so.
#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QStatusBar>
#include <QTableWidget>
#include <QWheelEvent>

#include "reading.h"
#include "vicon/scan_files/skeleton_file.h"

namespace vicon::viewer {
namespace {

/// With the supine scan as a cavity of the colon's shape.
class ReadingACavity : public test::Reading {
protected:
    void openCavity()
    {
        const auto folder = store_ / "cases" / test::kCase / test::kSupine;
        test::sayOrgan(folder, "stomach");
        scan_files::writeNoPath(folder / "skeleton.vtp", {});
        std::filesystem::remove(folder / "exit_distance.mha");
        openCase();
    }
    static double fromWall() { return station(); }  // the first number of the place
    static QString said() { return window()->statusBar()->currentMessage(); }
};

TEST_F(ReadingACavity, IsFlownByKeysAndIsPushedOffItsWall)
{
    openCavity();
    EXPECT_TRUE(the<QLabel>("where")->text().endsWith("mm from the wall"))
        << the<QLabel>("where")->text().toStdString();
    const double home_mm = fromWall();
    const QImage home = pictureOf("endoscopic");
    screenshot("cavity_home");
    the<QWidget>("endoscopic")->setFocus();
    // On into the wall for as long as it likes: it slides along it, and stays off it by more than the eye needs.
    double nearest_mm = home_mm;
    for (const int direction : {Qt::Key_W, Qt::Key_A, Qt::Key_S, Qt::Key_D}) {
        QTest::keyPress(QApplication::focusWidget(), Qt::Key(direction));
        const bool pressed = eventually([&] {
            nearest_mm = std::min(nearest_mm, fromWall());
            return fromWall() < 7;
        });
        EXPECT_TRUE(pressed) << direction << ": " << fromWall();
        QTest::keyRelease(QApplication::focusWidget(), Qt::Key(direction));
        EXPECT_TRUE(eventually([] { return fromWall() >= 7; })) << "let go, it is pushed back: " << fromWall();
    }
    EXPECT_GE(nearest_mm, 2);
    EXPECT_NE(pictureOf("endoscopic"), home);
    screenshot("cavity_flown");
    key(Qt::Key_Home);
    EXPECT_TRUE(eventually([&] { return fromWall() == home_mm; }));
}

TEST_F(ReadingACavity, WhatNeedsAPathSaysSo)
{
    openCavity();
    EXPECT_EQ(the<QComboBox>("mode")->currentText(), "free");
    for (const char* of_path : {"mode", "back", "forward", "about", "lookBack", "station", "jump"})
        EXPECT_FALSE(the<QWidget>(of_path)->isEnabled()) << of_path;
    const double home_mm = fromWall();
    for (const int command : {Qt::Key_P, Qt::Key_G, Qt::Key_Space, Qt::Key_R, Qt::Key_B, Qt::Key_J}) {
        window()->statusBar()->clearMessage();
        key(command);
        EXPECT_TRUE(said().startsWith("The stomach has no centreline")) << command << ": " << said().toStdString();
    }
    EXPECT_EQ(the<QComboBox>("mode")->currentText(), "free");
    EXPECT_EQ(fromWall(), home_mm);
    key(Qt::Key_M, Qt::ControlModifier);
    EXPECT_TRUE(said().contains("there is no way to film")) << said().toStdString();
    key(Qt::Key_C);
    EXPECT_TRUE(eventually([] { return warning().find("same place") != std::string::npos; })) << warning();
    EXPECT_TRUE(markers()->isColumnHidden(2)) << "no distance along anything";
}

TEST_F(ReadingACavity, IsMarkedAndMovedThroughByTheMouse)
{
    openCavity();
    const QImage home = pictureOf("endoscopic");
    auto* overview = the<QWidget>("overview");
    bool elsewhere = false;  // the first click that meets the lumen goes there
    for (int y = overview->height() / 4; y < overview->height() * 3 / 4 && !elsewhere; y += 8) {
        click("overview", QPoint(overview->width() * 2 / 5, y));
        waitUntilQuiet();
        elsewhere = pictureOf("endoscopic") != home;
    }
    EXPECT_TRUE(elsewhere);
    EXPECT_GT(fromWall(), 2);
    click("endoscopic", middle("endoscopic") + QPoint(40, 60), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); })) << warning();
    const QImage before = pictureOf("coronal");
    QWheelEvent turned(middle("coronal"), the<QWidget>("coronal")->mapToGlobal(middle("coronal")), {}, {0, 120},
                       Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(the<QWidget>("coronal"), &turned);
    EXPECT_TRUE(eventually([&] { return pictureOf("coronal") != before; })) << "the next slice";
    EXPECT_GT(fromWall(), 1);
    screenshot("cavity_marked");
}

}  // namespace
}  // namespace vicon::viewer
