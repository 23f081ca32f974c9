// Reading in two dimensions: layouts, the lumen followed, zoom, window, slab; by mouse and by keys.
#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QStatusBar>

#include "reading.h"
#include "slices/slice_view.h"
#include "test_colon.h"
#include "vicon/scan_files/stored_volume.h"
#include "vicon/viewer/model/window_level.h"

namespace vicon::viewer {
namespace {

using test::Reading;
using test::type;

class Reading2D : public Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        openCase();
        window()->resize(1600, 1000);
        waitUntilQuiet();
    }
    static void wheel(const char* view, int notches, Qt::KeyboardModifiers modifiers = {})
    {
        auto* widget = the<QWidget>(view);
        const QPointF at = widget->rect().center();
        QWheelEvent event(at, widget->mapToGlobal(at.toPoint()), {}, {0, 120 * notches}, Qt::NoButton, modifiers,
                          Qt::NoScrollPhase, false);
        QApplication::sendEvent(widget, &event);
    }
    static const PlaneView& shown(const char* view) { return the<SliceView>(view)->shown(); }
    /// Of the place that is looked at, in the view.
    static QPoint cross(const char* view)
    {
        const Pixel at = shown(view).toPixel(the<SliceView>(view)->point_mm());
        return {int(at.x), int(at.y)};
    }
    static int area(const char* view)
    {
        const QWidget* widget = the<QWidget>(view);
        return widget->isVisible() ? widget->width() * widget->height() : 0;
    }
    static bool isNear(const QColor& a, const QColor& b)
    {
        constexpr int kNear = 40;  // a smooth line covers a pixel in part
        return std::abs(a.red() - b.red()) < kNear && std::abs(a.green() - b.green()) < kNear &&
               std::abs(a.blue() - b.blue()) < kNear;
    }
    /// The colour of the rim of the lumen that is followed.
    static int rimPixels(const char* view)
    {
        const QImage image = pictureOf(view);
        int count = 0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                count += isNear(image.pixelColor(x, y), QColor(40, 205, 190));
        return count;
    }
    /// Of a picture's pixels, those that are as grey as the window makes the mean of so many by so many voxels.
    static double asAcquired(const char* name, const HuView& volume, int voxels)
    {
        const PlaneView view = shown(name);
        const WindowLevel window = windowPreset(the<QComboBox>("window")->currentText().toStdString());
        const QImage image = pictureOf(name);
        int same = 0, all = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                double sum_hu = 0;
                bool within = true;
                for (int n = 0; n < voxels * voxels; ++n) {
                    const Point3 p = view.pointAt({x + (n % voxels + 0.5) / voxels, y + (n / voxels + 0.5) / voxels});
                    const Index3 v = volume.grid.indexAt(p);
                    within = within && volume.grid.contains(v) && distance(volume.grid.pointAt(v), p) < 1e-6;
                    sum_hu += within ? volume.at(v) : 0;
                }
                if (!within)
                    continue;
                ++all;
                same += std::abs(qGray(image.pixel(x, y)) - int(window.greyOf(float(sum_hu / (voxels * voxels))))) <= 1;
            }
        return all > 0 ? double(same) / all : 0;
    }
    /// The picture of a slice is of the size that its view has by now.
    static bool fits(const char* view)
    {
        const auto* slice = dynamic_cast<SliceView*>(the<QWidget>(view));
        return !slice || slice->image().size() == slice->pictureSize();
    }
    static bool arrived(const char* view)
    {
        return eventually([=] { return drawn(view) && fits(view) && pictureIsThere(); });
    }
};

TEST_F(Reading2D, EachLayoutIsOneKeyAwayAndItsFirstViewIsTheLargestAndHasTheKeyboard)
{
    type(Qt::Key_F6);
    ASSERT_TRUE(arrived("axial"));
    EXPECT_EQ(QApplication::focusWidget(), the<QWidget>("axial"));
    EXPECT_GT(area("axial"), 2 * area("endoscopic"));
    EXPECT_GT(area("endoscopic"), 0) << "linked, and small";
    screenshot("hanging_2d");
    type(Qt::Key_H);
    ASSERT_TRUE(arrived("coronal"));
    EXPECT_EQ(QApplication::focusWidget(), the<QWidget>("coronal"));
    EXPECT_GT(area("coronal"), 2 * area("axial")) << "any plane";
    type(Qt::Key_F7);
    ASSERT_TRUE(eventually([] { return drawn("besideEndoscopic") && drawn("besideAxial"); })) << warning();
    for (const char* one : {"endoscopic", "axial", "besideEndoscopic", "besideAxial"})
        for (const char* other : {"endoscopic", "axial", "besideEndoscopic", "besideAxial"})
            EXPECT_GT(area(one) * 5 / 4, area(other)) << one << " and " << other << " are alike";
    EXPECT_FALSE(the<QWidget>("coronal")->isVisible());
    screenshot("hanging_both");
    type(Qt::Key_F8);
    ASSERT_TRUE(arrived("sagittal"));
    EXPECT_FALSE(the<QWidget>("besideAxial")->isVisible()) << "it came with the layout, and goes with it";
    for (const char* one : {"endoscopic", "axial", "coronal", "sagittal"})
        EXPECT_GT(area(one), 40000) << one;
    screenshot("hanging_planes");
    type(Qt::Key_F5);
    ASSERT_TRUE(arrived("endoscopic"));
    EXPECT_EQ(QApplication::focusWidget(), the<QWidget>("endoscopic"));
    EXPECT_GT(area("endoscopic"), area("axial"));
}

TEST_F(Reading2D, ASliceAcrossTheLumenFollowsItAndIsSeenAsFromInside)
{
    EXPECT_FALSE(the<QWidget>("across")->isVisible()) << "where no slice is large";
    type(Qt::Key_F6);
    ASSERT_TRUE(arrived("axial"));
    for (int n = 0; n < 3; ++n)
        type(Qt::Key_H);
    ASSERT_TRUE(eventually([] { return area("across") > 2 * area("axial"); }));
    ASSERT_TRUE(arrived("across"));
    EXPECT_EQ(QApplication::focusWidget(), the<QWidget>("across"));
    const auto* slice = the<SliceView>("across");
    for (int n = 0; n < 4; ++n) {
        const double before = station();
        const Point3 from_mm = slice->point_mm();
        wheel("across", 8);
        ASSERT_TRUE(eventually([&] { return station() > before + 5; })) << "each slice is the next";
        EXPECT_LT(station(), before + 8 * 4 + 1);
        waitUntilQuiet();
        ASSERT_TRUE(eventually([&] { return std::abs(shown("across").depth_mm(slice->point_mm())) < 0.1; }));
        EXPECT_GT(dot(shown("across").forward(), normalized(slice->point_mm() - from_mm)), 0.8) << "along the way";
        EXPECT_GT(rimPixels("across"), 40);
    }
    screenshot("across");
    const Point3 clicked = shown("across").pointAt({cross("across").x() + 10.5, cross("across").y() + 0.5});
    click("across", cross("across") + QPoint(10, 0), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); })) << warning();
    EXPECT_LT(distance(stored().back().position_mm, clicked), 0.5) << "a click means what it points at";
    const Vector3 forward = shown("across").forward();
    type(Qt::Key_R);
    EXPECT_TRUE(eventually([&] { return dot(shown("across").forward(), forward) < -0.99; })) << "the way it is flown";
    type(Qt::Key_H);
    ASSERT_TRUE(arrived("axial"));
    EXPECT_FALSE(the<QWidget>("across")->isVisible());
}

TEST_F(Reading2D, BothScansAreSeenInTheSamePlane)
{
    type(Qt::Key_F7);
    ASSERT_TRUE(eventually([] { return drawn("besideEndoscopic") && drawn("besideAxial"); })) << warning();
    const auto isAlong = [](const char* view, Vector3 forward) {
        return eventually([=] { return dot(shown(view).forward(), forward) > 0.999; });
    };
    EXPECT_TRUE(isAlong("axial", {0, 0, 1}) && isAlong("besideAxial", {0, 0, 1}));
    type(Qt::Key_H);
    EXPECT_TRUE(isAlong("coronal", {0, 1, 0}) && isAlong("besideAxial", {0, 1, 0}));
}

TEST_F(Reading2D, TheWheelAndKeysFollowTheLumenFromSliceToSlice)
{
    type(Qt::Key_F6);
    ASSERT_TRUE(arrived("axial"));
    ASSERT_TRUE(the<QAction>("tracks")->isChecked());
    ASSERT_TRUE(eventually([] { return rimPixels("axial") > 40; })) << "the lumen is outlined";
    const auto goes = [](auto step) {
        const double before = station();
        step();
        const bool went = eventually([&] { return station() > before + 0.5; });
        return went && station() < before + 4 * 4 + 1;
    };
    EXPECT_TRUE(goes([] { wheel("axial", 3); })) << "by the wheel";
    EXPECT_TRUE(goes([] {
        for (int n = 0; n < 3; ++n)
            type(Qt::Key_PageUp);
    })) << "by keys";
    // The slice is that of the centreline, and the place lies in the lumen.
    const SliceView* axial = the<SliceView>("axial");
    ASSERT_TRUE(eventually([&] { return std::abs(shown("axial").depth_mm(axial->point_mm())) < 0.1; }));
    screenshot("followed");
    const double there = station();
    wheel("axial", 5, Qt::ShiftModifier);
    EXPECT_TRUE(eventually([&] { return std::abs(shown("axial").depth_mm(axial->point_mm())) > 2; }));
    EXPECT_NEAR(station(), there, 0.5) << "with Shift through the slices, and the place stays";
    type(Qt::Key_Q);
    ASSERT_TRUE(eventually([] { return rimPixels("axial") == 0; }));
    wheel("axial", 2);
    waitUntilQuiet();
    EXPECT_NEAR(station(), there, 0.5) << "not followed";
    type(Qt::Key_Q);
    type(Qt::Key_Space);
    ASSERT_TRUE(eventually([&] { return station() > there + 60; })) << "cine";
    type(Qt::Key_Space);
    ASSERT_TRUE(eventually([&] { return std::abs(shown("axial").depth_mm(axial->point_mm())) < 0.1; }));
}

TEST_F(Reading2D, ReturnMeansWhatThePictureShowsAlsoWhereItIsStillThatOfTheLastPlace)
{
    constexpr double kMost_mm = 1.5;  // a pixel or two
    type(Qt::Key_F6);
    ASSERT_TRUE(arrived("axial"));
    for (int n = 1; n <= 4; ++n) {
        for (int centimetres = 0; centimetres < 6; ++centimetres)
            type(Qt::Key_Period);
        ASSERT_TRUE(arrived("axial"));
        waitUntilQuiet();
        const Point3 shown_mm = the<SliceView>("axial")->point_mm();
        type(Qt::Key_Period);
        type(Qt::Key_Return, Qt::ShiftModifier);
        ASSERT_TRUE(eventually([&] { return markers()->rowCount() == n && settled(); })) << warning();
        EXPECT_LT(distance(stored().back().position_mm, shown_mm), kMost_mm) << station();
    }
}

TEST_F(Reading2D, ZoomStaysOnTheCrossAlsoWhileTheLumenIsFollowed)
{
    type(Qt::Key_F6);
    ASSERT_TRUE(arrived("axial"));
    const QPoint before = cross("axial");
    const double scale = shown("axial").mm_per_pixel;
    wheel("axial", 6, Qt::ControlModifier);
    ASSERT_TRUE(eventually([&] { return shown("axial").mm_per_pixel < scale / 2; }));
    EXPECT_LE((cross("axial") - before).manhattanLength(), 2);
    const double there = station();
    wheel("axial", 10);
    ASSERT_TRUE(eventually([&] { return station() > there + 5; }));
    const auto crossIsAt = [](QPoint at) {
        return eventually([=] { return (cross("axial") - at).manhattanLength() <= 2; });
    };
    EXPECT_TRUE(crossIsAt(before)) << "the lumen stays under the eye";
    // A click beside the cross moves the cross, not the picture.
    const QPoint at = before + QPoint(60, 40);
    const Point3 middle_mm = shown("axial").centre_mm;
    const Point3 clicked = shown("axial").pointAt({at.x() + 0.5, at.y() + 0.5});
    click("axial", at);
    ASSERT_TRUE(eventually([&] { return distance(the<SliceView>("axial")->point_mm(), clicked) < 0.5; }));
    EXPECT_TRUE(crossIsAt(at));
    EXPECT_LT(distance(shown("axial").centre_mm, middle_mm), 0.5);
    wheel("axial", -8, Qt::ControlModifier);
    EXPECT_TRUE(eventually([&] { return std::abs(shown("axial").mm_per_pixel - scale) < 1e-9; })) << "all of it again";
}

TEST_F(Reading2D, TheSliceAcrossTheLumenPassesThroughEveryPlaceThatIsClicked)
{
    key(Qt::Key_F6);
    for (int n = 0; n < 3; ++n)
        key(Qt::Key_H);
    waitUntilQuiet();
    ASSERT_TRUE(the<QWidget>("across")->isVisible());
    const Skeleton path = test::TestColon().skeleton;
    const auto* across = the<SliceView>("across");
    for (const double station_mm : {60.0, 200.0, 110.0, 260.0, 20.0}) {
        SCOPED_TRACE(station_mm);
        const Pixel at = shown("coronal").toPixel(path.at(station_mm).position_mm);
        click("coronal", {int(at.x), int(at.y)});
        waitUntilQuiet();
        EXPECT_LT(std::abs(across->shown().depth_mm(across->point_mm())), 1e-6) << "the cross is where the picture is";
        EXPECT_TRUE(the<QWidget>("across")->rect().contains(cross("across")));
    }
    screenshot("across_clicked_place");
}

TEST_F(Reading2D, SlicesAreAKeyAwayFromWhatWasAcquiredPixelForPixel)
{
    const double whole = shown("axial").mm_per_pixel;
    type(Qt::Key_0, Qt::ControlModifier);
    ASSERT_TRUE(eventually([&] { return shown("axial").mm_per_pixel != whole; }));
    ASSERT_TRUE(arrived("axial"));
    const PlaneView& view = shown("axial");
    const Point3 a = view.pointAt({10.5, 10.5}), b = view.pointAt({11.5, 10.5});
    EXPECT_NEAR(distance(a, b), 2, 1e-9) << "the scan's voxels are two millimetres wide";
    EXPECT_LE(distance(view.centre_mm, the<SliceView>("axial")->point_mm()), 1.5) << "around the cross";
    type(Qt::Key_0);
    EXPECT_TRUE(eventually([&] { return shown("axial").mm_per_pixel == whole; }));
}

TEST_F(Reading2D, AClickBringsASliceFromHalfTheResolutionToTheAcquiredOnePixelForPixelAndBack)
{
    const scan_files::StoredVolume<std::int16_t> stored(CaseStore(store_).scanFolder(test::kCase, test::kSupine) /
                                                        "volume.mha");
    const HuView& volume = stored.view();
    type(Qt::Key_0);
    waitUntilQuiet();
    const double whole = shown("axial").mm_per_pixel, coronal = shown("coronal").mm_per_pixel;
    EXPECT_LT(asAcquired("axial", volume, 1), 0.1);
    type(Qt::Key_9, Qt::ControlModifier);
    waitUntilQuiet();
    EXPECT_NEAR(shown("axial").mm_per_pixel, 4, 1e-9) << "of voxels of two millimetres";
    constexpr double kNothingOver = 0.6;  // the rest lies under lines and words
    EXPECT_GT(asAcquired("axial", volume, 2), kNothingOver);
    const QPoint at = cross("axial") + QPoint(2, -3);
    const Point3 clicked = shown("axial").pointAt({at.x() + 0.5, at.y() + 0.5});
    click("axial", at, Qt::ControlModifier);
    waitUntilQuiet();
    EXPECT_NEAR(shown("axial").mm_per_pixel, 2, 1e-9);
    EXPECT_GT(asAcquired("axial", volume, 1), kNothingOver);
    EXPECT_LE(distance(shown("axial").centre_mm, clicked), 3.5) << "around the place that was clicked";
    EXPECT_NEAR(shown("coronal").mm_per_pixel, 4, 1e-9) << "the others stay";
    screenshot("pixel_for_pixel");
    click("axial", middle("axial"), Qt::ControlModifier);
    waitUntilQuiet();
    EXPECT_NEAR(shown("axial").mm_per_pixel, 4, 1e-9) << "back";
    type(Qt::Key_0);
    waitUntilQuiet();
    click("axial", middle("axial"), Qt::ControlModifier);
    waitUntilQuiet();
    EXPECT_NEAR(shown("axial").mm_per_pixel, 2, 1e-9);
    click("axial", middle("axial"), Qt::ControlModifier);
    waitUntilQuiet();
    EXPECT_EQ(shown("axial").mm_per_pixel, whole);
    EXPECT_EQ(shown("coronal").mm_per_pixel, coronal);
}

TEST_F(Reading2D, TheWindowIsSetByDraggingAndByNumberKeysInEverySlice)
{
    const auto* choice = the<QComboBox>("window");
    const auto meanGrey = [](const char* view) {
        const QImage image = pictureOf(view);
        double sum = 0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                sum += qGray(image.pixel(x, y));
        return sum / (image.width() * image.height());
    };
    for (int n = 0; n < 3; ++n) {
        type(Qt::Key_4 + n);
        EXPECT_EQ(choice->currentIndex(), n);
    }
    type(Qt::Key_5);
    EXPECT_EQ(choice->currentText(), "soft-tissue");
    waitUntilQuiet();
    const double before = meanGrey("axial"), coronal = meanGrey("coronal");
    drag("axial", middle("axial"), middle("axial") + QPoint(0, -60));
    EXPECT_EQ(choice->currentText(), "by hand");
    EXPECT_TRUE(eventually([&] { return meanGrey("axial") < before - 3; })) << "a higher level is darker";
    EXPECT_TRUE(eventually([&] { return meanGrey("coronal") < coronal - 3; }));
    screenshot("window_by_hand");
    closeCase();
    openCase();
    EXPECT_EQ(the<QComboBox>("window")->currentText(), "by hand") << "kept for the reader";
    type(Qt::Key_4);
    EXPECT_EQ(the<QComboBox>("window")->currentText(), "colon");
    EXPECT_EQ(the<QComboBox>("window")->findText("by hand"), -1);
}

TEST_F(Reading2D, ASlabShowsTheMeanOrTheMinimumAndSaysSo)
{
    const QImage thin = pictureOf("axial");
    type(Qt::Key_Y);
    ASSERT_TRUE(eventually([&] { return pictureOf("axial") != thin; }));
    waitUntilQuiet();
    const QImage mean = pictureOf("axial");
    type(Qt::Key_Y);
    ASSERT_TRUE(eventually([&] { return pictureOf("axial") != mean; }));
    waitUntilQuiet();
    const QImage minimum = pictureOf("axial");
    screenshot("slab");
    type(Qt::Key_Y, Qt::ShiftModifier);
    EXPECT_TRUE(eventually([&] { return pictureOf("axial") != minimum; })) << "thicker";
    type(Qt::Key_Y);
    EXPECT_TRUE(eventually([&] { return pictureOf("axial") == thin; }));
}

TEST_F(Reading2D, AHangingIsKeptForTheReaderWhateverTheCase)
{
    type(Qt::Key_F6);
    ASSERT_TRUE(arrived("axial"));
    type(Qt::Key_H);
    type(Qt::Key_6);
    type(Qt::Key_Q);
    type(Qt::Key_F6, Qt::ShiftModifier);
    EXPECT_TRUE(window()->statusBar()->currentMessage().contains("F6")) << "said";
    type(Qt::Key_F5);
    type(Qt::Key_4);
    ASSERT_TRUE(arrived("endoscopic"));
    closeCase();
    openCase();
    EXPECT_GT(area("endoscopic"), area("coronal")) << "as it was left";
    type(Qt::Key_F6);
    ASSERT_TRUE(arrived("coronal"));
    EXPECT_GT(area("coronal"), 2 * area("endoscopic"));
    EXPECT_EQ(the<QComboBox>("window")->currentIndex(), 2);
    EXPECT_FALSE(the<QAction>("tracks")->isChecked());
}

TEST_F(Reading2D, ACaseIsReadInSlicesFirstWithTheMouseAlwaysInThePicture)
{
    type(Qt::Key_F6);
    ASSERT_TRUE(arrived("axial"));
    wheel("axial", 10);
    ASSERT_TRUE(eventually([] { return station() > 8; }));
    type(Qt::Key_Period);
    ASSERT_TRUE(arrived("axial"));
    waitUntilQuiet();
    click("axial", cross("axial") + QPoint(6, 0), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); })) << warning();
    type(Qt::Key_M);
    click("axial", cross("axial") - QPoint(20, 0));
    click("axial", cross("axial") + QPoint(20, 0));
    EXPECT_TRUE(eventually([] { return window()->statusBar()->currentMessage().contains("straight"); }));
    type(Qt::Key_Escape);
    EXPECT_EQ(QApplication::focusWidget(), the<QWidget>("axial")) << "Esc gives the keyboard to the view read in";
    QTest::mouseDClick(the<QWidget>("axial"), Qt::LeftButton, {}, middle("axial"));
    EXPECT_FALSE(the<QWidget>("endoscopic")->isVisible());
    QTest::mouseDClick(the<QWidget>("axial"), Qt::LeftButton, {}, middle("axial"));
    EXPECT_TRUE(the<QWidget>("endoscopic")->isVisible());
    type(Qt::Key_X);
    ASSERT_TRUE(eventually([] { return drawn("axial") && drawn("endoscopic") && pictureIsThere(); }));
    EXPECT_GT(area("axial"), 2 * area("endoscopic")) << "the other scan hangs alike";
    type(Qt::Key_F2);
    ASSERT_TRUE(eventually([] { return the<QWidget>("endoscopic")->window() != window(); }));
    EXPECT_EQ(the<QWidget>("axial")->window(), window()) << "the view read in stays in the main window";
    type(Qt::Key_F2);
    EXPECT_TRUE(eventually([] { return the<QWidget>("endoscopic")->window() == window(); }));
}

}  // namespace
}  // namespace vicon::viewer
