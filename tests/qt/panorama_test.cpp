// The unfolded cube, the band and the projection that turns, with mouse and keys.
#include <QAction>
#include <QDockWidget>
#include <QLabel>
#include <QStatusBar>
#include <QWheelEvent>
#include <cmath>

#include "reading.h"
#include "widgets/picture_view.h"

namespace vicon::viewer {
namespace {

using test::Reading;

void wheel(QWidget* over, QPoint at, int notches, Qt::KeyboardModifiers modifiers = {})
{
    QWheelEvent event(at, over->mapToGlobal(at), {}, {0, 120 * notches}, Qt::NoButton, modifiers, Qt::NoScrollPhase,
                      false);
    QApplication::sendEvent(over, &event);
}

void dragBy(QWidget* over, QPoint from, QPoint by, Qt::MouseButton button = Qt::LeftButton)
{
    QTest::mousePress(over, button, {}, from);
    constexpr int kSteps = 4;
    for (int n = 1; n <= kSteps; ++n) {
        QMouseEvent move(QEvent::MouseMove, from + by * n / kSteps, button, button, {});
        QApplication::sendEvent(over, &move);
    }
    QTest::mouseRelease(over, button, {}, from + by);
}

class Panoramas : public Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        openCase();
        window()->resize(1500, 1000);
        waitUntilQuiet();
    }
    /// Until it has changed, and then no more.
    static bool changesFrom(const char* view, const QImage& before)
    {
        const bool changed = eventually([&] { return pictureOf(view) != before; });
        waitUntilQuiet();
        return changed;
    }
    static bool isShown(const char* view)
    {
        return eventually([&] { return the<QWidget>(view)->isVisible() && drawn(view); });
    }
};

TEST_F(Panoramas, TheCubeIsAKeyAwayFollowsTheEyeAndAClickLooksThere)
{
    EXPECT_FALSE(the<QWidget>("cube")->isVisible());
    key(Qt::Key_U);
    ASSERT_TRUE(isShown("cube"));
    screenshot("cube");
    const QImage first = pictureOf("cube");
    const QImage inside = pictureOf("endoscopic");
    key(Qt::Key_Period);
    EXPECT_TRUE(changesFrom("cube", first)) << "a centimetre on";
    const QImage moved = pictureOf("cube");
    // The face that is looked back on lies on the right.
    auto* cube = the<QWidget>("cube");
    click("cube", QPoint(cube->width() * 7 / 8, cube->height() / 2 + 5));
    EXPECT_TRUE(changesFrom("cube", moved));
    EXPECT_NE(pictureOf("endoscopic"), inside);
    screenshot("cube_clicked");
    key(Qt::Key_U);
    EXPECT_TRUE(eventually([] { return !the<QWidget>("cube")->isVisible(); }));
}

TEST_F(Panoramas, ALengthIsMeasuredOnTheCubeAndItsEndsAreDraggedThere)
{
    key(Qt::Key_U);
    ASSERT_TRUE(isShown("cube"));
    waitUntilQuiet();
    auto* cube = the<PictureView>("cube");
    const QImage inside = pictureOf("endoscopic"), plain = pictureOf("cube");
    const QPoint front(cube->width() * 3 / 8, cube->height() / 2);  // the middle of its face
    const QPoint first = front + QPoint(20, 30), second = front + QPoint(45, 30);
    key(Qt::Key_M);
    click("cube", first);
    EXPECT_TRUE(cube->calliper()) << "the first end is shown";
    click("cube", second);
    const auto said = [] { return window()->statusBar()->currentMessage(); };
    ASSERT_TRUE(eventually([&] { return said().contains("along"); })) << said().toStdString() << warning();
    waitUntilQuiet();
    screenshot("measured_on_cube");
    ASSERT_TRUE(cube->calliper() && cube->calliper()->grips[0] && cube->calliper()->grips[1]);
    const auto end = [&](std::size_t which) {
        const QPointF at = cube->calliper().value().grips[which].value();
        return cube->toWidget({at.x(), at.y()}).toPoint();
    };
    constexpr int kCorner_px = 16;  // to the nearest corner of this coarse wall
    EXPECT_LT((end(0) - first).manhattanLength(), kCorner_px);
    EXPECT_LT((end(1) - second).manhattanLength(), kCorner_px);
    EXPECT_NE(pictureOf("cube"), plain);
    EXPECT_NE(pictureOf("endoscopic"), inside) << "the same line in the other view of this scan";
    const double before = said().section(' ', 0, 0).toDouble();
    const QPoint to = end(1) + QPoint(30, 0);
    dragBy(cube, end(1), QPoint(30, 0));
    EXPECT_TRUE(eventually([&] { return said().section(' ', 0, 0).toDouble() > 1.3 * before; }))
        << said().toStdString();
    waitUntilQuiet();
    EXPECT_LT((end(1) - to).manhattanLength(), kCorner_px);
    key(Qt::Key_Escape);
    EXPECT_TRUE(eventually([&] { return !cube->calliper(); }));
}

TEST_F(Panoramas, TheBandGoesWhereItIsClickedAndScrollsAndIsWholeOnADoubleClick)
{
    key(Qt::Key_B, Qt::ShiftModifier);
    ASSERT_TRUE(isShown("band"));
    screenshot("band");
    // So high that not all of this small colon fits into a row.
    the<QDockWidget>("bandDock")->setFloating(true);
    the<QDockWidget>("bandDock")->resize(420, 420);
    ASSERT_TRUE(eventually([] { return the<QWidget>("band")->height() > 350; }));
    waitUntilQuiet();
    auto* band = the<QWidget>("band");
    const QImage stretch = pictureOf("band");
    wheel(band, band->rect().center(), 2);
    ASSERT_TRUE(changesFrom("band", stretch)) << "the wheel goes along";
    const double before = station();
    wheel(band, band->rect().center(), -1, Qt::ControlModifier);
    screenshot("band_whole");
    click("band", QPoint(band->width() / 2, band->height() * 3 / 4));
    ASSERT_TRUE(eventually([&] { return std::abs(station() - before) > 30; }));
    ASSERT_TRUE(eventually([] { return pictureIsThere(); }));
    screenshot("band_clicked");
    const QImage whole = pictureOf("band");
    wheel(band, band->rect().center(), 1, Qt::ControlModifier);
    ASSERT_TRUE(changesFrom("band", whole));
    const QImage there = pictureOf("band");
    const double here = station();
    click("band", QPoint(band->width() / 3, band->height() / 2));
    QTest::mouseDClick(band, Qt::LeftButton, {}, QPoint(band->width() / 3, band->height() / 2));
    EXPECT_TRUE(changesFrom("band", there)) << "a double click shows all of it";
    EXPECT_NEAR(station(), here, 1) << "and goes nowhere";
}

TEST_F(Panoramas, TheBandRunsTheWayThatIsFlown)
{
    key(Qt::Key_B, Qt::ShiftModifier);
    ASSERT_TRUE(isShown("band"));
    waitUntilQuiet();
    const QImage to_caecum = pictureOf("band");
    key(Qt::Key_R);
    EXPECT_TRUE(changesFrom("band", to_caecum));
}

TEST_F(Panoramas, AMarkerIsSetInCubeAndBand)
{
    key(Qt::Key_U);
    ASSERT_TRUE(isShown("cube"));
    waitUntilQuiet();
    auto* cube = the<QWidget>("cube");
    click("cube", QPoint(cube->width() * 3 / 8, cube->height() / 2 + 20), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    key(Qt::Key_B, Qt::ShiftModifier);
    ASSERT_TRUE(isShown("band"));
    waitUntilQuiet();
    auto* band = the<QWidget>("band");
    click("band", QPoint(band->width() / 2, band->height() / 2), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 2 && settled(); }));
    screenshot("panorama_markers");
    for (const Marker& marker : stored()) {
        EXPECT_EQ(marker.scan_id, test::kSupine);
        EXPECT_GT(marker.station_mm, 0);
    }
}

TEST_F(Panoramas, ALengthIsMeasuredInTheBandAndItsEndsAreDraggedThere)
{
    key(Qt::Key_B, Qt::ShiftModifier);
    ASSERT_TRUE(isShown("band"));
    waitUntilQuiet();
    auto* band = the<PictureView>("band");
    const QPoint first = band->rect().center() + QPoint(10, 10), second = first + QPoint(25, 0);
    key(Qt::Key_M);
    click("band", first);
    ASSERT_TRUE(eventually([&] { return band->calliper().has_value(); })) << "the first end is shown";
    click("band", second);
    const auto said = [] { return window()->statusBar()->currentMessage(); };
    ASSERT_TRUE(eventually([&] { return said().contains("along"); })) << said().toStdString() << warning();
    waitUntilQuiet();
    screenshot("measured_in_band");
    ASSERT_TRUE(band->calliper() && band->calliper()->grips[0] && band->calliper()->grips[1]);
    EXPECT_TRUE(band->calliper()->text.contains("stretched"));
    const auto end = [&](std::size_t which) {
        const QPointF at = band->calliper().value().grips[which].value();
        return band->toWidget({at.x(), at.y()}).toPoint();
    };
    constexpr int kCorner_px = 16;  // to the nearest corner of this coarse wall
    EXPECT_LT((end(0) - first).manhattanLength(), kCorner_px);
    EXPECT_LT((end(1) - second).manhattanLength(), kCorner_px);
    const double before = said().section(' ', 0, 0).toDouble();
    const QPoint to = end(1) + QPoint(25, 0);
    dragBy(band, end(1), QPoint(25, 0));
    EXPECT_TRUE(eventually([&] { return said().section(' ', 0, 0).toDouble() > 1.3 * before; }))
        << said().toStdString();
    waitUntilQuiet();
    EXPECT_LT((end(1) - to).manhattanLength(), kCorner_px);
    key(Qt::Key_Escape);
    EXPECT_TRUE(eventually([&] { return !band->calliper(); }));
}

/// How many pixels became greener, and how many changed otherwise, by more than rounding.
std::pair<int, int> changes(const QImage& before, const QImage& after)
{
    constexpr int kRounding = 2;
    int greener = 0, otherwise = 0;
    for (int y = 0; y < after.height(); ++y)
        for (int x = 0; x < after.width(); ++x) {
            const QColor was = before.pixelColor(x, y), is = after.pixelColor(x, y);
            const int by = std::max(
                {std::abs(was.red() - is.red()), std::abs(was.green() - is.green()), std::abs(was.blue() - is.blue())});
            if (by <= kRounding)
                continue;
            ++(is.green() - is.red() > was.green() - was.red() ? greener : otherwise);
        }
    return {greener, otherwise};
}

TEST_F(Panoramas, TheProjectionTurnsGrowsIsClickedAndComesBackFromTheFront)
{
    auto* overview = the<QWidget>("overview");
    const auto reviewed_percent = [] { return the<QLabel>("seen")->text().section(' ', 0, 0).toDouble(); };
    const double reviewed_before = reviewed_percent();
    const QImage front = pictureOf("overview");
    dragBy(overview, overview->rect().center(), QPoint(60, 15));
    ASSERT_TRUE(changesFrom("overview", front));
    screenshot("turned");
    const QImage turned = pictureOf("overview");
    wheel(overview, overview->rect().center(), 2);
    ASSERT_TRUE(changesFrom("overview", turned));
    const QImage grown = pictureOf("overview");
    dragBy(overview, overview->rect().center(), QPoint(20, 10), Qt::RightButton);
    ASSERT_TRUE(changesFrom("overview", grown));
    screenshot("turned_grown");
    const QImage moved = pictureOf("overview");
    overview->setFocus(Qt::TabFocusReason);
    for (int n = 0; n < 4; ++n)
        test::type(Qt::Key_Left, Qt::ControlModifier | Qt::ShiftModifier);
    ASSERT_TRUE(changesFrom("overview", moved)) << "keys turn it too";
    screenshot("turned_by_keys");
    // Some place of it is wall.
    const double before = station();
    bool went = false;
    for (int y = overview->height() / 4; y < overview->height() * 3 / 4 && !went; y += 12)
        for (int x = overview->width() / 8; x < overview->width() / 3 && !went; x += 12) {
            click("overview", QPoint(x, y));
            went = std::abs(station() - before) > 20;
        }
    EXPECT_TRUE(went);
    EXPECT_TRUE(eventually([&] { return reviewed_percent() > reviewed_before; })) << "what is looked at there counts";
    key(Qt::Key_Home);
    key(Qt::Key_Z);
    // What was reviewed meanwhile is painted, as on the turned one; all else is as it was.
    EXPECT_TRUE(eventually([&] {
        const auto [greener, otherwise] = changes(front, pictureOf("overview"));
        return greener > 20 && otherwise == 0;
    }));
    screenshot("turned_back");
    const double back_at = station();
    click("overview", QPoint(overview->width() * 2 / 3, overview->height() / 2));
    EXPECT_TRUE(eventually([&] { return std::abs(station() - back_at) > 50; })) << "clicks go there as before";
}

TEST_F(Panoramas, AnotherScanIsShownInAllOfThem)
{
    key(Qt::Key_U);
    key(Qt::Key_B, Qt::ShiftModifier);
    ASSERT_TRUE(isShown("cube"));
    ASSERT_TRUE(isShown("band"));
    the<QLabel>("where")->clear();
    key(Qt::Key_X);
    waitForScan();
    EXPECT_TRUE(isShown("cube"));
    EXPECT_TRUE(isShown("band"));
    closeCase();
    openCase();
    EXPECT_TRUE(isShown("cube")) << "as the reader left it";
    EXPECT_TRUE(isShown("band"));
}

TEST_F(Panoramas, TheBandStaysWhereAnotherScanIsNotOpenedAfterAll)
{
    key(Qt::Key_B, Qt::ShiftModifier);
    ASSERT_TRUE(isShown("band"));
    waitUntilQuiet();
    const QImage before = pictureOf("band");
    key(Qt::Key_X);
    ASSERT_TRUE(the<QWidget>("opening")->isVisible());
    press(window(), "openingCancel");
    waitUntilQuiet();
    EXPECT_EQ(pictureOf("band"), before);
    screenshot("band_after_cancelled_opening");
}

}  // namespace
}  // namespace vicon::viewer
