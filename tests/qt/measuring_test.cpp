#include <QComboBox>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QStatusBar>
#include <QTableWidget>
#include <cmath>

#include "measuring.h"
#include "vicon/cases/finding_facts.h"
#include "widgets/picture_view.h"

namespace vicon::viewer {
namespace {

using test::Measuring;
using test::MeasuringBeside;
using test::Outlining;

TEST_F(Measuring, ItsWordsNeverLieOverTheLineAlsoAtThePicturesEdge)
{
    zoom("coronal", 3);
    const QPoint last(the<QWidget>("coronal")->width() - 16, middle("coronal").y());
    measuredBetween("coronal", last - QPoint(60, 0), last);
    screenshot("measured_at_the_edge");
    EXPECT_GE(calliperBetween("coronal", last - QPoint(60, 0), last), 0.9);
}

TEST_F(Measuring, InAZoomedSliceEveryDirectionMeasuresWhatItsScaleSays)
{
    zoom("coronal", 6);
    const QPoint first = middle("coronal") + QPoint(-40, -30);
    // 80 pixels each way: 1 mm on the screen is 1 mm measured, whichever way and however often.
    const double across = measuredBetween("coronal", first, first + QPoint(80, 0));
    EXPECT_GE(calliperBetween("coronal", first, first + QPoint(80, 0)), 0.9) << "the line lies where it was clicked";
    screenshot("measured_in_slice");
    const double down = measuredBetween("coronal", first, first + QPoint(0, 80));
    const double half = measuredBetween("coronal", first + QPoint(40, 0), first + QPoint(80, 0));
    EXPECT_NEAR(across, down, 0.1);
    EXPECT_NEAR(across, 2 * half, 0.15);
    zoom("coronal", -6);
    const double whole = measuredBetween("coronal", first, first + QPoint(80, 0));
    EXPECT_NEAR(whole / across, std::pow(1.2, 6), 0.05) << "by what the wheel zoomed";
}

TEST_F(Measuring, NoViewMovesBetweenTheClicks)
{
    zoom("axial", 5);
    zoom("coronal", 3);
    key(Qt::Key_M);
    const QImage coronal = pictureOf("coronal"), sagittal = pictureOf("sagittal"), inside = pictureOf("endoscopic");
    const QImage axial = pictureOf("axial");
    const QPoint first = middle("axial") + QPoint(50, 30);
    click("axial", first);
    waitUntilQuiet();
    EXPECT_TRUE(yellow(pictureOf("axial").pixelColor(first + QPoint(0, 4)))) << "the first end is shown";
    const QPoint away = middle("axial") - QPoint(60, 40);
    EXPECT_EQ(pictureOf("axial").pixel(away), axial.pixel(away));
    EXPECT_EQ(pictureOf("endoscopic"), inside);
    int moved = 0;
    for (const auto& [view, before] : {std::pair("coronal", &coronal), std::pair("sagittal", &sagittal)}) {
        const QImage now = pictureOf(view);
        for (int y = 0; y < now.height(); y += 3)
            for (int x = 0; x < now.width(); x += 3)
                moved += now.pixel(x, y) != before->pixel(x, y);
    }
    EXPECT_LT(moved, 60) << "but for the end itself";
}

TEST_F(Measuring, ASizeIsReplacedOnlyWhenTheReaderSaysSoAndUndoBringsItBack)
{
    mark();
    const QPoint first = middle("endoscopic") + QPoint(90, 60);
    key(Qt::Key_M);
    click("endoscopic", first);
    click("endoscopic", first + QPoint(100, 0));
    ASSERT_TRUE(eventually([&] { return stored()[0].size.has_value() && settled(); }));
    const double kept = straight();
    const QPoint end = endIn("endoscopic", 1);
    const auto again = [&] {
        key(Qt::Key_M);
        click("endoscopic", first);
        click("endoscopic", first + QPoint(60, 0));
    };
    again();
    ASSERT_TRUE(eventually([] { return window()->findChild<QMessageBox*>("replaceSize") != nullptr; }));
    EXPECT_EQ(straight(), kept) << "asked first";
    screenshot("replace_size");
    the<QMessageBox>("replaceSize")->grab().save(VICON_SCREENSHOTS "/replace_size_question.png");
    answer("keepOld");
    waitUntilQuiet();
    EXPECT_EQ(straight(), kept);
    again();
    answer("replace");
    ASSERT_TRUE(eventually([&] { return straight() < kept && settled(); }));
    EXPECT_EQ(cell(0, 5), QString::number(largestDiameter_mm(stored()[0].size.value()), 'f', 1));
    key(Qt::Key_Z, Qt::ControlModifier);
    ASSERT_TRUE(eventually([&] { return straight() == kept && settled(); }));
    EXPECT_TRUE(eventually([&] { return endIn("endoscopic", 1) == end; })) << "the callipers are the old ones again";
}

TEST_F(Measuring, AnEndThatIsDraggedMeasuresAnewAndIsUndone)
{
    mark();
    zoom("coronal", 4);
    // The slice has the marker that is chosen in its middle.
    clickRow(markers(), 0);
    waitUntilQuiet();
    const QPoint first = middle("coronal") + QPoint(-20, 0), second = first + QPoint(40, 0);
    key(Qt::Key_M);
    click("coronal", first);
    click("coronal", second);
    ASSERT_TRUE(eventually([&] { return stored()[0].size.has_value() && settled(); })) << said().toStdString();
    const double before = straight();
    drag("coronal", second, second + QPoint(40, 0));
    screenshot("dragged");
    ASSERT_TRUE(eventually([&] { return straight() > before && settled(); })) << said().toStdString() << warning();
    EXPECT_NEAR(straight(), 2 * before, 0.05 * before);
    EXPECT_TRUE(stored()[0].size.value().in_slice);
    EXPECT_GE(calliperBetween("coronal", first, second + QPoint(40, 0)), 0.9);
    EXPECT_EQ(window()->findChild<QMessageBox*>("replaceSize"), nullptr) << "it was this size that was dragged";
    key(Qt::Key_Z, Qt::ControlModifier);
    ASSERT_TRUE(eventually([&] { return straight() == before && settled(); }));
    EXPECT_TRUE(eventually([&] { return (endIn("coronal", 1) - second).manhattanLength() <= kMouse_px; }));
    EXPECT_TRUE(said().startsWith("Undone")) << said().toStdString();
    key(Qt::Key_Escape);
    EXPECT_TRUE(eventually([&] { return calliperBetween("coronal", first, second) < 0.2; }));
    clickRow(markers(), 0);
    EXPECT_TRUE(eventually([&] { return calliperBetween("coronal", first, second) > 0.9; }))
        << "the marker that is chosen shows its size";
}

TEST_F(MeasuringBeside, ALengthInTheOtherScansSliceIsDrawnDraggedAndKeptThereAlone)
{
    // Below the middle, where the cross is: a marker of the other scan, and a length beside it.
    const QPoint first = middle("besideAxial") + QPoint(-30, 30), second = first + QPoint(60, 0);
    click("besideAxial", first, Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    ASSERT_EQ(stored()[0].scan_id, test::kProne);
    zoom("besideAxial", 2);
    const QImage axial = pictureOf("axial");
    key(Qt::Key_M);
    click("besideAxial", first);
    click("besideAxial", second);
    ASSERT_TRUE(eventually([&] { return stored()[0].size.has_value() && settled(); })) << said().toStdString();
    waitUntilQuiet();
    screenshot("measured_beside");
    EXPECT_GE(calliperBetween("besideAxial", first, second), 0.9);
    EXPECT_EQ(pictureOf("axial"), axial) << "nothing of it in the scan that is read";
    const double before = straight();
    drag("besideAxial", second, second + QPoint(60, 0));
    ASSERT_TRUE(eventually([&] { return straight() > before && settled(); })) << said().toStdString() << warning();
    EXPECT_NEAR(straight(), 2 * before, 0.05 * before);
    EXPECT_GE(calliperBetween("besideAxial", first, second + QPoint(60, 0)), 0.9);
    EXPECT_EQ(stored()[0].scan_id, test::kProne);
}

TEST_F(MeasuringBeside, TheOtherScansWallIsMeasuredFromInside)
{
    const QImage inside = pictureOf("endoscopic");
    const QPoint middle_of_it = middle("besideEndoscopic");
    key(Qt::Key_M);
    click("besideEndoscopic", middle_of_it + QPoint(40, 50));
    click("besideEndoscopic", middle_of_it + QPoint(70, 50));
    ASSERT_TRUE(eventually([] { return said().contains("along"); })) << said().toStdString() << warning();
    waitUntilQuiet();
    screenshot("measured_beside_inside");
    const auto* view = the<PictureView>("besideEndoscopic");
    const auto end = [&](std::size_t which) {
        const QPointF at = view->calliper().value().grips[which].value();
        return view->toWidget({at.x(), at.y()}).toPoint();
    };
    ASSERT_TRUE(view->calliper());
    const QPoint first = end(0), second = end(1);  // of the wall the nearest corners
    EXPECT_GE(calliperBetween("besideEndoscopic", first, first), 0.9);
    EXPECT_LT((second - middle_of_it - QPoint(70, 50)).manhattanLength(), 16);
    EXPECT_EQ(pictureOf("endoscopic"), inside);
    const double before = firstLength(said());
    drag("besideEndoscopic", second, second + QPoint(40, 0));
    EXPECT_TRUE(eventually([&] { return firstLength(said()) > 1.2 * before; })) << said().toStdString();
    key(Qt::Key_Escape);
    EXPECT_TRUE(eventually([&] { return !view->calliper(); }));
}

TEST_F(MeasuringBeside, NoLengthReachesFromOneScanToTheOtherWhicheverWasClickedFirst)
{
    for (const auto& [one, other] : {std::pair("besideAxial", "axial"), std::pair("axial", "besideAxial")}) {
        SCOPED_TRACE(one);
        const QPoint first = middle(one) + QPoint(-30, 30);
        key(Qt::Key_M);
        click(one, first);
        click(other, middle(other) + QPoint(30, 30));
        ASSERT_TRUE(eventually([] { return warning().find("in one scan") != std::string::npos; })) << warning();
        EXPECT_FALSE(said().contains("straight")) << said().toStdString();
        click(one, first + QPoint(40, 0));
        EXPECT_TRUE(eventually([] { return said().contains("straight"); })) << said().toStdString();
        EXPECT_GE(calliperBetween(one, first, first + QPoint(40, 0)), 0.9);
        key(Qt::Key_Escape);
    }
}

TEST_F(MeasuringBeside, AnEndInTheScanBesideIsForgottenWhenThatIsClosed)
{
    const QPoint first = middle("axial") + QPoint(-30, 30);
    key(Qt::Key_M);
    click("besideAxial", middle("besideAxial"));
    key(Qt::Key_C);
    ASSERT_TRUE(eventually([] { return !the<QWidget>("beside")->isVisible(); }));
    click("axial", first);
    click("axial", first + QPoint(40, 0));
    EXPECT_TRUE(eventually([] { return said().contains("straight"); })) << said().toStdString() << warning();
}

TEST_F(MeasuringBeside, ALineGoesAlongWithItsScanWhenTheTwoChangePlaces)
{
    const QPoint first = middle("besideAxial") + QPoint(-30, 30);
    measuredBetween("besideAxial", first, first + QPoint(60, 0));
    openOther();
    waitUntilQuiet();
    EXPECT_FALSE(the<PictureView>("besideAxial")->calliper()) << "that scan is read now";
    EXPECT_TRUE(the<PictureView>("axial")->calliper());
}

TEST_F(Outlining, OneClickMeasuresAPolyp)
{
    key(Qt::Key_M, Qt::ShiftModifier);
    click("endoscopic", middle("endoscopic"));
    ASSERT_TRUE(eventually([&] { return outlined().has_value() && settled(); })) << said().toStdString() << warning();
    screenshot("outlined");
    const PolypSize polyp = outlined().value();
    EXPECT_NEAR(polyp.diameter_mm, 2 * colon_.polyp_radius_mm, kVoxel_mm);
    EXPECT_TRUE(said().contains("outlined")) << said().toStdString();
    EXPECT_TRUE(said().contains("mm in the best plane")) << said().toStdString();
    const QString bounds =
        QString("(%1 to %2)").arg(*polyp.volume_least_ml, 0, 'f', 3).arg(*polyp.volume_most_ml, 0, 'f', 3);
    EXPECT_TRUE(said().contains(" ml " + bounds)) << said().toStdString();
    ASSERT_TRUE(stored()[0].size->plane);
    EXPECT_LE(stored()[0].size->plane->diameter_mm, polyp.diameter_mm);
    EXPECT_EQ(cell(0, 5), QString::number(polyp.diameter_mm, 'f', 1));
    key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_TRUE(eventually([&] { return !stored()[0].size && settled(); }));
}

TEST_F(Outlining, AClickIntoAPolypInASliceOutlinesItInEveryLayout)
{
    const auto outlinesIn = [&](const char* layout) {
        SCOPED_TRACE(layout);
        ASSERT_TRUE(eventually([] { return drawn("coronal"); }));
        waitUntilQuiet();
        key(Qt::Key_M, Qt::ShiftModifier);
        click("coronal", placeIn("coronal", colon_.polyp_mm));
        ASSERT_TRUE(eventually([&] { return outlined().has_value() && settled(); }))
            << said().toStdString() << warning();
        screenshot((std::string("outlined_in_slice_") + layout).c_str());
        EXPECT_NEAR(outlined().value().diameter_mm, 2 * colon_.polyp_radius_mm, kVoxel_mm);
        EXPECT_EQ(warning(), "");
        key(Qt::Key_Z, Qt::ControlModifier);
        ASSERT_TRUE(eventually([&] { return !stored()[0].size && settled(); }));
    };
    zoom("coronal", 4);
    outlinesIn("beside");
    QTest::mouseDClick(the<QWidget>("coronal"), Qt::LeftButton, {}, middle("coronal"));
    ASSERT_TRUE(eventually([] { return !the<QWidget>("endoscopic")->isVisible(); }));
    outlinesIn("enlarged");
    QTest::mouseDClick(the<QWidget>("coronal"), Qt::LeftButton, {}, middle("coronal"));
    key(Qt::Key_F8);
    outlinesIn("planes");
}

TEST_F(Outlining, WhereAClickInASliceHitsNoPolypTheTwoEndsAreAskedFor)
{
    const auto asksFor = [](QPoint at) {
        key(Qt::Key_Escape);
        key(Qt::Key_M, Qt::ShiftModifier);
        click("coronal", at);
        EXPECT_TRUE(eventually([] { return QString::fromStdString(warning()).contains("Click on its two ends"); }))
            << warning();
    };
    const Vector3 outwards = normalized(colon_.polyp_mm - path_.at(colon_.polyp_station_mm).position_mm);
    asksFor(placeIn("coronal", path_.at(colon_.polyp_station_mm).position_mm));  // in the lumen's middle
    asksFor(placeIn("coronal", colon_.polyp_mm + outwards * 9));                 // in the fat behind it
    EXPECT_FALSE(stored()[0].size);
    const QPoint first = placeIn("coronal", colon_.polyp_mm);
    click("coronal", first);
    click("coronal", first + QPoint(20, 0));
    EXPECT_TRUE(eventually([] { return said().contains("straight"); })) << said().toStdString();
}

TEST_F(Outlining, WhereThereIsNoPolypTheTwoEndsAreAskedFor)
{
    key(Qt::Key_Home);
    ASSERT_TRUE(eventually([] { return station() < 2 && pictureIsThere(); }));
    key(Qt::Key_M, Qt::ShiftModifier);
    const QPoint bare = middle("endoscopic") + QPoint(90, 60);
    click("endoscopic", bare);
    ASSERT_TRUE(eventually([] { return QString::fromStdString(warning()).contains("two ends"); })) << warning();
    EXPECT_FALSE(stored()[0].size);
    click("endoscopic", bare);
    click("endoscopic", bare + QPoint(30, 0));
    EXPECT_TRUE(eventually([] { return said().contains("straight"); })) << said().toStdString();
}

TEST_F(Measuring, ADoubleClickEnlargesTheViewAndLeavesTheEyeWhereItWas)
{
    key(Qt::Key_End);
    ASSERT_TRUE(eventually([] { return length() - station() < 2 && pictureIsThere(); }));
    for (const char* view : {"axial", "coronal", "endoscopic"}) {
        SCOPED_TRACE(view);
        auto* widget = the<QWidget>(view);
        const QPoint at = middle(view) + QPoint(30, 20);
        const int width = widget->width();
        // As a mouse does: press, release, double click, release.
        QTest::mouseClick(widget, Qt::LeftButton, {}, at);
        QTest::mouseDClick(widget, Qt::LeftButton, {}, at);
        ASSERT_TRUE(eventually([&] { return widget->width() > width; }));
        waitUntilQuiet();
        EXPECT_LT(length() - station(), 2);
        EXPECT_EQ(the<QComboBox>("mode")->currentText(), "planned");
        QTest::mouseClick(widget, Qt::LeftButton, {}, at);
        QTest::mouseDClick(widget, Qt::LeftButton, {}, at);
        ASSERT_TRUE(eventually([&] { return widget->width() == width; }));
        EXPECT_EQ(the<QComboBox>("mode")->currentText(), "planned");
    }
}

TEST_F(Measuring, ADoubleClickTakesNothingBackThatWasBeforeIt)
{
    click("endoscopic", middle("endoscopic") + QPoint(90, 60));
    key(Qt::Key_End);
    ASSERT_TRUE(eventually([] { return length() - station() < 2 && pictureIsThere(); }));
    auto* overview = the<QWidget>("overview");
    const QPoint background(20, overview->height() - 20);
    drag("overview", background, background + QPoint(60, 0));
    waitUntilQuiet();
    const int width = overview->width();
    QTest::mouseClick(overview, Qt::LeftButton, {}, background);
    QTest::mouseDClick(overview, Qt::LeftButton, {}, background);
    ASSERT_TRUE(eventually([&] { return overview->width() > width; }));
    waitUntilQuiet();
    EXPECT_LT(length() - station(), 2);
}

TEST_F(Measuring, ADoubleClickOnTheProjectionEnlargesItAndLeavesTheEyeWhereItWas)
{
    auto* overview = the<QWidget>("overview");
    const int width = overview->width();
    const QPoint at(width * 2 / 3, overview->height() / 2);
    QTest::mouseClick(overview, Qt::LeftButton, {}, at);
    QTest::mouseDClick(overview, Qt::LeftButton, {}, at);
    ASSERT_TRUE(eventually([&] { return overview->width() > 2 * width; }));
    screenshot("projection_alone");
    EXPECT_LT(station(), 2);
    QTest::mouseDClick(overview, Qt::LeftButton, {}, at);
    EXPECT_TRUE(eventually([&] { return overview->width() == width; })) << overview->width();
    EXPECT_TRUE(the<QWidget>("endoscopic")->isVisible());
}

TEST_F(Measuring, TheEndOfTheFlightAWallTooNearAndLookingBackAreSaid)
{
    key(Qt::Key_End);
    ASSERT_TRUE(eventually([] { return length() - station() < 2; }));
    key(Qt::Key_R);  // the way to the caecum, which is here
    key(Qt::Key_Space);
    EXPECT_TRUE(eventually([] { return said().contains("where the flight ends"); })) << said().toStdString();
    EXPECT_EQ(the<QPushButton>("about")->text(), "Retrograde");
    key(Qt::Key_F);
    QTest::keyPress(window(), Qt::Key_D);
    EXPECT_TRUE(eventually([] { return the<QLabel>("notice")->text().contains("close to the wall"); }));
    QTest::keyRelease(window(), Qt::Key_D);
    screenshot("close_to_the_wall");
    auto* back = the<QPushButton>("lookBack");
    ASSERT_TRUE(back->isEnabled()) << "no mode takes it away";
    QTest::mouseClick(back, Qt::LeftButton);
    EXPECT_TRUE(eventually([&] { return back->isChecked(); }));
    EXPECT_EQ(the<QComboBox>("mode")->currentText(), "planned");
    EXPECT_TRUE(the<QLabel>("notice")->text().isEmpty());
}

}  // namespace
}  // namespace vicon::viewer
