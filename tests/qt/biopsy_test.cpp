// The virtual biopsy: a finding is circled, looked into, and its density kept.
#include <QLabel>
#include <QMessageBox>
#include <QTableWidget>

#include "reading.h"
#include "test_colon.h"
#include "vicon/scan_files/volume_file.h"

namespace vicon::viewer {
namespace {

using test::Reading;

TEST_F(Reading, AnAreaThatIsCircledIsPeeledAloneAndItsDensityKeptWithTheMarkerUntilUndone)
{
    openCase();
    const QPoint at = middle("endoscopic") + QPoint(-150, 20);
    click("endoscopic", at, Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    waitUntilQuiet();
    auto* view = the<QWidget>("endoscopic");
    const QImage plain = view->grab().toImage();
    const QPoint controls = the<QWidget>("mode")->mapTo(window(), {0, 0});
    key(Qt::Key_T);
    QTest::mousePress(view, Qt::LeftButton, {}, at);
    for (int n = 1; n <= 5; ++n)
        QTest::mouseMove(view, at + QPoint(22 * n, 0));
    screenshot("circling");
    QTest::mouseRelease(view, Qt::LeftButton, {}, at + QPoint(110, 0));
    ASSERT_TRUE(eventually([&] { return stored()[0].density.has_value() && settled(); })) << warning();
    const auto density = stored()[0].density.value();
    EXPECT_GE(density.voxels, 20U);
    EXPECT_GT(density.mean_hu, -90) << "a wall of 40 HU before fat of -90";
    EXPECT_LT(density.mean_hu, 45);
    EXPECT_TRUE(the<QLabel>("histogram")->isVisible());
    EXPECT_EQ(the<QWidget>("mode")->mapTo(window(), {0, 0}), controls) << "it pushes nothing away";
    EXPECT_FALSE(the<QWidget>("mode")->visibleRegion().isEmpty());
    screenshot("biopsy");
    // Far from the circle the wall is drawn as it was; in its middle something else is.
    ASSERT_TRUE(
        eventually([&] { return view->grab().toImage().pixel(at + QPoint(6, 6)) != plain.pixel(at + QPoint(6, 6)); }));
    const QImage peeled = view->grab().toImage();
    const QPoint far = middle("endoscopic") + QPoint(200, 150);
    constexpr int kSmoothing = 12;  // grey levels: one picture may have been drawn while the eye moved
    EXPECT_NEAR(qRed(peeled.pixel(far)), qRed(plain.pixel(far)), kSmoothing);
    EXPECT_NEAR(qGreen(peeled.pixel(far)), qGreen(plain.pixel(far)), kSmoothing);
    EXPECT_NEAR(qBlue(peeled.pixel(far)), qBlue(plain.pixel(far)), kSmoothing);
    clickRow(markers(), 0);
    key(Qt::Key_I);
    auto* box = the<QMessageBox>("markerInformation");
    EXPECT_TRUE(box->text().contains("HU, of "));
    EXPECT_TRUE(eventually([&] { return box->findChild<QLabel*>("measures") != nullptr; }));
    waitUntilQuiet();
    box->grab().save(VICON_SCREENSHOTS "/biopsy_information.png");
    box->close();
    press(window(), "undo");
    ASSERT_TRUE(eventually([&] { return !stored()[0].density.has_value() && settled(); }));
    press(window(), "redo");
    ASSERT_TRUE(eventually([&] { return stored()[0].density.has_value() && settled(); }));
    window()->activateWindow();
    ASSERT_TRUE(eventually([] { return window()->isActiveWindow(); }));
    key(Qt::Key_Escape);
    EXPECT_TRUE(eventually([] { return !the<QLabel>("histogram")->isVisible(); }));
}

TEST_F(Reading, WhatIsCircledAndThenMarkedKeepsItsDensityWhetherItIsMeasuredByThenOrNot)
{
    openCase();
    waitUntilQuiet();
    const QPoint at = middle("endoscopic") + QPoint(-150, 20);
    for (const bool measured : {true, false}) {
        key(Qt::Key_T);
        drag("endoscopic", at, at + QPoint(110, 0));
        if (measured) {
            ASSERT_TRUE(eventually([&] { return said().contains("no marker beside it"); })) << said().toStdString();
            waitUntilQuiet();
        }
        key(Qt::Key_1);
        click("endoscopic", at);
        ASSERT_TRUE(eventually([&] { return stored().size() == 1 && stored()[0].density && settled(); }))
            << (measured ? "after its density" : "before its density") << ": " << warning();
        EXPECT_TRUE(the<QLabel>("histogram")->isVisible());
        screenshot(measured ? "biopsy_then_marked" : "biopsy_and_marked");
        for (int step = 0; step < 2; ++step) {  // the density, then the marker
            press(window(), "undo");
            ASSERT_TRUE(eventually([&] { return settled(); }));
        }
        ASSERT_TRUE(eventually([&] { return stored().empty(); }));
        waitUntilQuiet();
    }
}

/// A supine scan whose wall is one voxel of tissue before fat.
class ReadingOfAThinWall : public Reading {
protected:
    void SetUp() override
    {
        constexpr std::int16_t kFat_hu = -90;
        Reading::SetUp();
        const test::TestColon colon;
        HuVolume volume = colon.volume;
        for (std::size_t n = 0; n < volume.voxels.size(); ++n)
            if (!besideLumen(colon.inside, volume.grid.indexOf(n)))
                volume.voxels[n] = kFat_hu;
        scan_files::writeVolume(CaseStore(store_).scanFolder(test::kCase, test::kSupine) / "volume.mha", volume,
                                scan_files::Packing::raw);
    }

private:
    static bool besideLumen(const InsideVolume& inside, Index3 v)
    {
        for (int n = 0; n < 27; ++n)
            if (const Index3 near{v.i + n % 3 - 1, v.j + n / 3 % 3 - 1, v.k + n / 9 - 1};
                inside.grid.contains(near) && inside.at(near) != kOutside)
                return true;
        return false;
    }
};

TEST_F(ReadingOfAThinWall, ABiopsyIsRefusedWithItsReasonAndNothingIsKept)
{
    openCase();
    const QPoint at = middle("endoscopic") + QPoint(-150, 20);
    click("endoscopic", at, Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    waitUntilQuiet();
    key(Qt::Key_T);
    drag("endoscopic", at, at + QPoint(110, 0));
    EXPECT_TRUE(eventually([] { return !warning().empty(); }));
    EXPECT_NE(warning().find("too little tissue between its surface and its far side"), std::string::npos) << warning();
    EXPECT_NE(warning().find("nothing was taken"), std::string::npos) << warning();
    waitUntilQuiet();
    screenshot("biopsy_refused");
    EXPECT_FALSE(stored()[0].density.has_value());
    EXPECT_FALSE(the<QLabel>("histogram")->isVisible());
}

}  // namespace
}  // namespace vicon::viewer
