// Densities in slices: read under the pointer, and taken of what is circled.
#include <QAction>
#include <QMouseEvent>
#include <QStatusBar>

#include "reading.h"
#include "slices/slice_view.h"
#include "test_colon.h"
#include "vicon/cases/case_store.h"
#include "vicon/scan_files/volume_file.h"

namespace vicon::viewer {
namespace {

using test::Reading;

class Densities : public Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        const auto folder = CaseStore(store_).scanFolder(test::kCase, test::kSupine);
        colon_.write(folder);
        HuVolume clean = colon_.volume;
        std::fill(clean.voxels.begin(), clean.voxels.end(), std::int16_t(0));
        scan_files::writeVolume(folder / "cleansed.mha", clean, scan_files::Packing::raw);
        Marker marker;
        marker.scan_id = test::kSupine;
        marker.position_mm = colon_.polyp_mm - outwards_ * colon_.polyp_radius_mm;
        marker.station_mm = colon_.polyp_station_mm;
        CaseStore(store_).saveMarker(test::kCase, marker);
        openCase();
        window()->resize(1600, 1000);
        waitUntilQuiet();
        clickRow(markers(), 0);
        ASSERT_TRUE(eventually([] { return pictureIsThere(); }));
        waitUntilQuiet();
    }
    static SliceView* slice(const char* view) { return the<SliceView>(view); }
    static void hover(const char* view, QPoint at)
    {
        auto* widget = the<QWidget>(view);
        QMouseEvent move(QEvent::MouseMove, at, widget->mapToGlobal(at), Qt::NoButton, Qt::NoButton, {});
        QApplication::sendEvent(widget, &move);
    }
    static QString readAt(const char* view, QPoint at)
    {
        hover(view, at);
        return slice(view)->readout();
    }
    static QPoint placeIn(const char* view, Point3 p)
    {
        const Pixel at = slice(view)->shown().toPixel(p);
        return {int(at.x), int(at.y)};
    }
    static void zoom(const char* view, int notches)
    {
        auto* widget = the<QWidget>(view);
        const QPointF at = widget->rect().center();
        QWheelEvent event(at, widget->mapToGlobal(at.toPoint()), {}, {0, 120 * notches}, Qt::NoButton,
                          Qt::ControlModifier, Qt::NoScrollPhase, false);
        QApplication::sendEvent(widget, &event);
        waitUntilQuiet();
    }
    bool taken() const { return stored()[0].density.has_value() && settled(); }
    static int pixels(const char* view, double mm) { return int(mm / slice(view)->shown().mm_per_pixel); }

    static constexpr double kVoxel_mm = 1, kTissueHu = 40;
    static constexpr double kSeam_hu = 20;  // the seam between polyp and wall is drawn half as air
    const test::TestColon colon_{test::storages().front(), kVoxel_mm};
    const Vector3 outwards_ = normalized(
        colon_.polyp_mm - colon_.skeleton.at(colon_.skeleton.nearest(colon_.polyp_mm).station_mm).position_mm);
};

TEST_F(Densities, TheAcquiredOneUnderThePointerStandsInTheSlice)
{
    key(Qt::Key_0, Qt::ControlModifier);  // each pixel is a voxel
    waitUntilQuiet();
    const HuVolume& volume = colon_.volume;
    std::vector<int> read;
    for (const QPoint off : {QPoint(0, 0), QPoint(-12, 3), QPoint(9, -7), QPoint(30, 20)}) {
        const QPoint at = placeIn("coronal", colon_.polyp_mm) + off;
        const Point3 p = slice("coronal")->shown().pointAt({at.x() + 0.5, at.y() + 0.5});
        const int hu = volume.at(volume.grid.indexAt(p));
        EXPECT_EQ(readAt("coronal", at), QString("%1 HU").arg(hu));
        read.push_back(hu);
    }
    EXPECT_GT(*std::max_element(read.begin(), read.end()), 0);
    EXPECT_LT(*std::min_element(read.begin(), read.end()), -500) << "tissue and gas";
    screenshot("density_read");
    const QPoint polyp = placeIn("coronal", colon_.polyp_mm);
    const QString of_polyp = readAt("coronal", polyp);
    key(Qt::Key_K);
    waitUntilQuiet();
    EXPECT_EQ(slice("coronal")->readout(), of_polyp + " as acquired") << "also where the slices are cleansed";
    screenshot("density_read_cleansed");
    key(Qt::Key_K);
    waitUntilQuiet();
    zoom("coronal", -20);
    EXPECT_EQ(readAt("coronal", {1, 1}), "") << "outside the scan there is none";
    hover("coronal", polyp);
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(slice("coronal"), &leave);
    EXPECT_EQ(slice("coronal")->readout(), "");
}

TEST_F(Densities, WhatIsReadIsOfThePictureThatIsShownAndGoesWhileTheMouseDrags)
{
    hover("axial", placeIn("axial", colon_.polyp_mm));
    const QString before = slice("axial")->readout();
    ASSERT_NE(before, "");
    for (int n = 0; n < 12 && slice("axial")->readout() == before;
         ++n)  // until there is other tissue below the pointer
        key(Qt::Key_Period), waitUntilQuiet();
    EXPECT_NE(slice("axial")->readout(), before) << "the pointer rests, and the slice moves";
    drag("axial", middle("axial"), middle("axial") + QPoint(0, 30));
    EXPECT_EQ(slice("axial")->readout(), "");
}

TEST_F(Densities, AreTakenOfWhatIsCircledInASlice)
{
    zoom("coronal", 4);
    key(Qt::Key_T);
    const QPoint polyp = placeIn("coronal", colon_.polyp_mm);
    drag("coronal", polyp, polyp + QPoint(pixels("coronal", colon_.polyp_radius_mm), 0));
    ASSERT_TRUE(eventually([&] { return taken(); })) << warning();
    const DensitySample sample = stored()[0].density.value();
    EXPECT_NEAR(sample.mean_hu, kTissueHu, kSeam_hu);
    EXPECT_NEAR(sample.radius_mm, colon_.polyp_radius_mm, 0.5);
    EXPECT_LT(distance(sample.centre_mm, colon_.polyp_mm), 1.5);
    ASSERT_TRUE(slice("coronal")->ring()) << "where it was taken is shown";
    EXPECT_NEAR(slice("coronal")->ring()->radius_px, pixels("coronal", colon_.polyp_radius_mm), 3);
    EXPECT_TRUE(slice("axial")->ring());
    screenshot("density_taken_in_slice");
    key(Qt::Key_Escape);
    EXPECT_FALSE(slice("coronal")->ring());
}

TEST_F(Densities, AreTakenInASliceByTheKeyboard)
{
    key(Qt::Key_F8);
    ASSERT_TRUE(eventually([] { return drawn("coronal"); }));
    zoom("coronal", 4);
    auto* view = slice("coronal");
    view->setFocus(Qt::TabFocusReason);
    key(Qt::Key_T);
    view->setFocus(Qt::TabFocusReason);
    const QPoint from = placeIn("coronal", view->point_mm()), to = placeIn("coronal", colon_.polyp_mm);
    const auto go = [&](QPoint by) {
        for (; by.x() != 0; by.rx() -= by.x() > 0 ? 1 : -1)
            QTest::keyClick(view, by.x() > 0 ? Qt::Key_Right : Qt::Key_Left, Qt::ShiftModifier);
        for (; by.y() != 0; by.ry() -= by.y() > 0 ? 1 : -1)
            QTest::keyClick(view, by.y() > 0 ? Qt::Key_Down : Qt::Key_Up, Qt::ShiftModifier);
    };
    go(to - from);
    EXPECT_TRUE(view->readout().endsWith("HU")) << "read at the cross: " << view->readout().toStdString();
    QTest::keyClick(view, Qt::Key_Return);
    go({pixels("coronal", colon_.polyp_radius_mm), 0});
    QTest::keyClick(view, Qt::Key_Return);
    ASSERT_TRUE(eventually([&] { return taken(); })) << warning();
    EXPECT_NEAR(stored()[0].density.value().mean_hu, kTissueHu, kSeam_hu);
}

TEST_F(Densities, AreRefusedInASliceAsFromInside)
{
    zoom("coronal", 10);
    const auto refuses = [&](Point3 middle_mm, double radius_mm, const char* words) {
        key(Qt::Key_T);
        const QPoint at = placeIn("coronal", middle_mm);
        drag("coronal", at, at + QPoint(std::max(12, pixels("coronal", radius_mm)), 0));
        EXPECT_TRUE(eventually([=] { return warning().find(words) != std::string::npos; })) << warning();
        EXPECT_FALSE(slice("coronal")->ring());
        key(Qt::Key_Escape);
        waitUntilQuiet();
    };
    refuses(colon_.polyp_mm - outwards_ * 8, 3, "lies in the lumen");
    refuses(colon_.polyp_mm - outwards_ * 2.5, 1, "too little tissue");
    EXPECT_FALSE(stored()[0].density);
}

}  // namespace
}  // namespace vicon::viewer
