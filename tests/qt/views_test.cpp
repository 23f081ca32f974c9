#include <QAction>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSplitter>
#include <QTableWidget>

#include "reading.h"
#include "vicon/core/error.h"
#include "vicon/scan_files/volume_file.h"

namespace vicon::viewer {
namespace {

using test::Reading;

TEST_F(Reading, SlicesProjectionAndPeelingFollowTheMouse)
{
    openCase();
    auto* overview = the<QWidget>("overview");
    const double before = station();
    click("overview", QPoint(overview->width() * 2 / 3, overview->height() / 2));
    ASSERT_TRUE(eventually([&] { return std::abs(station() - before) > 50; }));
    screenshot("jumped");
    auto* window_choice = the<QComboBox>("window");
    window_choice->setFocus();
    QTest::keyClick(window_choice, Qt::Key_Down);
    EXPECT_EQ(window_choice->currentText(), "soft-tissue");
    const double width = the<QWidget>("coronal")->width();
    QTest::mouseDClick(the<QWidget>("coronal"), Qt::LeftButton, {}, middle("coronal"));
    EXPECT_FALSE(the<QWidget>("endoscopic")->isVisible());
    ASSERT_TRUE(eventually([&] { return the<QWidget>("coronal")->width() > 2 * width; }));
    screenshot("enlarged");
    QTest::mouseDClick(the<QWidget>("coronal"), Qt::LeftButton, {}, middle("coronal"));
    EXPECT_TRUE(the<QWidget>("endoscopic")->isVisible());
    waitUntilQuiet();  // it has its size again
    const QImage plain = pictureOf("endoscopic");
    auto* peel = the<QComboBox>("peel");
    peel->setFocus();
    QTest::keyClick(peel, Qt::Key_Down);
    ASSERT_TRUE(eventually([&] { return pictureOf("endoscopic") != plain; }));
    screenshotNow("peeled");
    QTest::mouseClick(the<QWidget>("peelCircle"), Qt::LeftButton, {},
                      QPoint(8, the<QWidget>("peelCircle")->height() / 2));
    const auto hover = [](QPoint at) { QTest::mouseMove(the<QWidget>("endoscopic"), at); };
    // The ring around the circle is the same light grey at its left and right end.
    const auto circleIsAt = [](QPoint at) {
        const QImage image = pictureOf("endoscopic");
        const int radius = int(0.3 * std::min(image.width(), image.height()));
        for (const int side : {-1, 1}) {
            bool ring = false;
            for (int n = -2; n <= 2; ++n)
                ring = ring || qGray(image.pixel(at.x() + side * radius + n, at.y())) > 200;
            if (!ring)
                return false;
        }
        return true;
    };
    for (const QPoint by : {QPoint(-80, -80), QPoint(80, 80)}) {
        const QPoint at = middle("endoscopic") + by;
        hover(at);
        EXPECT_TRUE(eventually([&] { return circleIsAt(at); })) << at.x() << ", " << at.y();
    }
    screenshotNow("lens");
    EXPECT_TRUE(the<QWidget>("endoscopic")->toolTip().isEmpty()) << "it would lie over what is peeled";
}

TEST_F(Reading, TheListOfMarkersHasRoomInALowWindowAndNothingIsSqueezedForIt)
{
    openCase();
    constexpr int kLeastRows = 5, kLeastOverview_px = 200;
    for (const QSize size : {QSize(1280, 700), QSize(1280, 900), QSize(1920, 1200)}) {
        window()->resize(size);
        ASSERT_TRUE(eventually([&] { return window()->size() == size; }));
        waitUntilQuiet();
        EXPECT_GE(markers()->viewport()->visibleRegion().boundingRect().height(),
                  kLeastRows * markers()->verticalHeader()->defaultSectionSize())
            << size.height();
        EXPECT_GE(the<QWidget>("overview")->height(), kLeastOverview_px) << size.height();
        for (const QPushButton* button : the<QWidget>("markerTable")->findChildren<QPushButton*>()) {
            EXPECT_EQ(button->visibleRegion().boundingRect().size(), button->size())
                << button->text().toStdString() << " at " << size.height();
            EXPECT_GT(button->width(), button->fontMetrics().horizontalAdvance(button->text()));
        }
        screenshot(("list_" + std::to_string(size.height())).c_str());
    }
}

TEST_F(Reading, AmbientOcclusionIsThereFromTheFirstAndWithoutItIsRemembered)
{
    openCase();
    EXPECT_TRUE(the<QAction>("ambientOcclusion")->isChecked());
    const QImage shaded = pictureOf("endoscopic");
    screenshot("ambient_occlusion");
    the<QAction>("ambientOcclusion")->trigger();
    ASSERT_TRUE(eventually([&] { return pictureOf("endoscopic") != shaded; }));
    waitUntilQuiet();
    const QImage plain = pictureOf("endoscopic");
    closeCase();
    openCase();
    EXPECT_FALSE(the<QAction>("ambientOcclusion")->isChecked());
    EXPECT_TRUE(eventually([&] { return pictureOf("endoscopic") == plain; }));
    the<QAction>("ambientOcclusion")->trigger();
    EXPECT_TRUE(eventually([&] { return pictureOf("endoscopic") == shaded; }));
}

TEST_F(Reading, TheLookOfTheWallIsChosenAndRemembered)
{
    openCase();
    waitUntilQuiet();
    const auto look = [](const char* title) {
        for (QAction* action : window()->findChildren<QAction*>())
            if (action->text().startsWith(title))
                return action;
        throw Error(ErrorCode::not_found, "no such look", title);
    };
    EXPECT_TRUE(look("Wall: mucosa")->isChecked());
    const QImage mucosa = pictureOf("endoscopic");
    look("Wall: bone")->trigger();
    ASSERT_TRUE(eventually([&] { return pictureOf("endoscopic") != mucosa; }));
    EXPECT_FALSE(look("Wall: mucosa")->isChecked()) << "one at a time";
    waitUntilQuiet();
    const QImage bone = pictureOf("endoscopic");
    screenshot("bone");
    closeCase();
    openCase();
    EXPECT_TRUE(look("Wall: bone")->isChecked());
    EXPECT_TRUE(eventually([&] { return pictureOf("endoscopic") == bone; }));
    look("Wall: mucosa")->trigger();
    EXPECT_TRUE(eventually([&] { return pictureOf("endoscopic") == mucosa; }));
}

TEST_F(Reading, SlicesWithoutTaggingAreOneKeyAwayAndNeverTheFirst)
{
    const std::filesystem::path scan = CaseStore(store_).scanFolder(test::kCase, test::kSupine);
    HuVolume clean = scan_files::readVolume<std::int16_t>(scan / "volume.mha");
    std::fill(clean.voxels.begin(), clean.voxels.end(), std::int16_t(0));
    scan_files::writeVolume(scan / "cleansed.mha", clean, scan_files::Packing::raw);
    openCase();
    const QImage acquired = pictureOf("axial");
    for (int opened = 0; opened < 2; ++opened) {
        key(Qt::Key_K);
        ASSERT_TRUE(eventually([&] { return pictureOf("axial") != acquired; }));
        screenshot("cleansed");
        if (opened == 0) {
            closeCase();
            openCase();
            EXPECT_TRUE(eventually([&] { return pictureOf("axial") == acquired; })) << "opened with what was acquired";
        }
    }
    key(Qt::Key_K);
    EXPECT_TRUE(eventually([&] { return pictureOf("axial") == acquired; }));
}

TEST_F(Reading, SlicesWithoutTaggingAreSoInBothScansOrSayThatTheyAreNot)
{
    const std::filesystem::path scan = CaseStore(store_).scanFolder(test::kCase, test::kProne);
    HuVolume clean = scan_files::readVolume<std::int16_t>(scan / "volume.mha");
    std::fill(clean.voxels.begin(), clean.voxels.end(), std::int16_t(0));
    scan_files::writeVolume(scan / "cleansed.mha", clean, scan_files::Packing::raw);
    openCase();
    key(Qt::Key_C);
    ASSERT_TRUE(eventually([] { return drawn("besideAxial"); }));
    waitUntilQuiet();
    const QImage acquired = pictureOf("axial"), beside = pictureOf("besideAxial");
    key(Qt::Key_K);
    ASSERT_TRUE(eventually([&] { return pictureOf("besideAxial") != beside; })) << "the other scan, too";
    waitUntilQuiet();
    screenshot("cleansed_beside");
    EXPECT_NE(pictureOf("axial"), acquired) << "nothing was taken out of this one, and it says so";
    key(Qt::Key_K);
    EXPECT_TRUE(eventually([&] { return pictureOf("axial") == acquired && pictureOf("besideAxial") == beside; }));
}

TEST_F(Reading, TheWallAsAcquiredIsOneKeyAwayCountsNothingAndIsNeverTheFirst)
{
    openCase();
    waitUntilQuiet();
    const QImage surface = pictureOf("endoscopic");
    const QString seen = the<QLabel>("seen")->text();
    key(Qt::Key_K, Qt::ControlModifier);
    ASSERT_TRUE(eventually([&] { return pictureOf("endoscopic") != surface; }));
    waitUntilQuiet();
    screenshot("as-acquired");
    const double from = station();
    press(window(), "forward");
    ASSERT_TRUE(eventually([&] { return station() > from + 40; }));
    press(window(), "stop");
    waitUntilQuiet();
    EXPECT_EQ(the<QLabel>("seen")->text(), seen) << "the wall itself was not in these pictures";
    key(Qt::Key_K, Qt::ControlModifier);
    EXPECT_TRUE(eventually([&] { return the<QLabel>("seen")->text() != seen; }));
    key(Qt::Key_Home);
    EXPECT_TRUE(eventually([&] { return pictureOf("endoscopic") == surface; }));
    key(Qt::Key_K, Qt::ControlModifier);
    closeCase();
    openCase();
    EXPECT_TRUE(eventually([&] { return pictureOf("endoscopic") == surface; })) << "opened with the surface";
}

TEST_F(Reading, WhatWasSeenIsCountedPaintedListedAndKept)
{
    const auto seen = [] { return the<QLabel>("seen")->text().section(' ', 0, 0).toDouble(); };
    const auto picture = [] { return pictureOf("endoscopic"); };
    openCase();
    ASSERT_TRUE(eventually([&] { return seen() > 0; }));
    for (int n = 0; n < 4; ++n)
        key(Qt::Key_Plus);
    const double before = seen();
    press(window(), "forward");
    ASSERT_TRUE(eventually([] { return station() > 250; }));
    press(window(), "stop");
    ASSERT_TRUE(eventually([&] { return seen() > before + 10; }));
    waitUntilQuiet();
    // Ahead nothing was seen earlier; behind the wall was, and is painted.
    key(Qt::Key_V);
    waitUntilQuiet();
    key(Qt::Key_R);
    const auto green = [&] {
        const QImage image = picture();
        int count = 0;
        for (int y = 0; y < image.height(); y += 4)
            for (int x = 0; x < image.width(); x += 4) {
                const QColor c = image.pixelColor(x, y);
                count += c.green() > 40 && c.green() > c.red() * 5 / 4 ? 1 : 0;
            }
        return double(count) * 16 / (image.width() * image.height());
    };
    EXPECT_TRUE(eventually([&] { return green() > 0.2; })) << green();
    screenshot("seen");
    key(Qt::Key_V);
    EXPECT_TRUE(eventually([&] { return green() < 0.02; })) << green();

    showList(1);
    auto* list = the<QTableWidget>("unseen");
    ASSERT_TRUE(eventually([&] { return list->rowCount() > 0; }));
    for (int row = 1; row < list->rowCount(); ++row)
        EXPECT_LE(list->item(row - 1, 1)->text().toDouble(), list->item(row, 1)->text().toDouble());
    const int last = list->rowCount() - 1;
    const double there = list->item(last, 1)->text().toDouble();
    clickRow(list, last);
    EXPECT_TRUE(eventually([&] { return std::abs(station() - there) < 40; })) << station() << " for " << there;
    screenshot("unseen");
    const double kept = seen();
    closeCase();
    openCase();
    EXPECT_TRUE(eventually([&] { return seen() >= kept; })) << seen() << " after " << kept;
    press(window(), "forgetSeen");
    EXPECT_TRUE(eventually([&] { return seen() < before + 1; })) << seen();
}

TEST_F(Reading, SlicesAndProjectionMoveToASecondWindowThatHasTheKeysAndIsRemembered)
{
    openCase();
    QWidget* mine = window();
    const int width = the<QWidget>("endoscopic")->width();
    key(Qt::Key_F2);
    ASSERT_TRUE(eventually([&] { return the<QWidget>("coronal")->window() != mine; }));
    auto* second = the<QWidget>("second");
    ASSERT_TRUE(eventually([] { return drawn("coronal") && drawn("overview") && drawn("endoscopic"); }));
    waitUntilQuiet();
    second->grab().save(VICON_SCREENSHOTS "/second_window.png");
    screenshot("first_of_two");
    EXPECT_EQ(the<QWidget>("endoscopic")->window(), mine);
    EXPECT_EQ(the<QWidget>("markers")->window(), mine);
    QTest::keyClick(second, Qt::Key_End);
    EXPECT_TRUE(eventually([] { return length() - station() < 2; }));
    QTest::mouseDClick(the<QWidget>("coronal"), Qt::LeftButton, {}, middle("coronal"));
    EXPECT_TRUE(the<QWidget>("endoscopic")->isVisible()) << "the other window stays as it is";
    EXPECT_FALSE(the<QWidget>("sagittal")->isVisible());
    EXPECT_FALSE(the<QWidget>("overview")->isVisible());
    QTest::mouseDClick(the<QWidget>("coronal"), Qt::LeftButton, {}, middle("coronal"));
    EXPECT_TRUE(the<QWidget>("overview")->isVisible());
    auto* rows = qobject_cast<QSplitter*>(second);
    rows->setSizes({second->height() / 5, second->height() * 4 / 5});
    const int projection = the<QWidget>("overview")->height();
    closeCase();
    openCase();
    EXPECT_NE(the<QWidget>("coronal")->window(), window()) << "remembered";
    EXPECT_NEAR(the<QWidget>("overview")->height(), projection, 3) << "as are its parts";
    the<QWidget>("second")->close();
    EXPECT_TRUE(eventually([] { return the<QWidget>("coronal")->window() == window(); }));
    EXPECT_TRUE(eventually([] { return the<QWidget>("overview")->isVisible(); }));
    constexpr int kHandles_px = 20;
    EXPECT_TRUE(eventually([&] { return std::abs(the<QWidget>("endoscopic")->width() - width) < kHandles_px; }))
        << the<QWidget>("endoscopic")->width() << " for " << width;
}

}  // namespace
}  // namespace vicon::viewer
