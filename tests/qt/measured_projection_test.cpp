// A measured line on the projection of the colon: from the front, turned, and on that of the scan beside.
#include <numbers>

#include "measuring.h"

namespace vicon::viewer {
namespace {

using test::Measuring;
using test::MeasuringBeside;

/// Two markers with sizes on the transverse colon, which runs from one side of the patient to the other.
class MeasuredProjection : public Measuring {
protected:
    enum Row { along, through };

    void SetUp() override
    {
        Reading::SetUp();
        const Point3 left = frontAt(6), right = {-6, left.y, left.z};
        saveMeasured(store_, colon_, left, right);  // on the front, in the plane that is seen from there
        saveMeasured(store_, colon_, left, {left.x, behind_mm_, left.z});  // from the front to the back
        openCase();
        window()->resize(1600, 1000);
        waitUntilQuiet();
    }
    /// The wall's foremost point of this sagittal plane; behind_mm_: how far the wall behind it is.
    Point3 frontAt(double x_mm)
    {
        constexpr double kTop_mm = 45, kSlab_mm = 1.5;
        Point3 front{0, 1e9, 0};
        for (std::size_t n = 0; n < colon_.cells.pointCount(); ++n)
            if (const Point3 p = colon_.cells.point(n);
                std::abs(p.x - x_mm) < kSlab_mm && p.z > kTop_mm && p.y < front.y)
                front = p;
        const Point3 middle = colon_.skeleton.at(colon_.skeleton.nearest(front).station_mm).position_mm;
        behind_mm_ = 2 * middle.y - front.y;
        return front;
    }
    void show(Row row)
    {
        clickRow(markers(), row);
        ASSERT_TRUE(eventually([] { return overview()->calliper().has_value() && pictureIsThere(); }));
        waitUntilQuiet();
    }
    static PictureView* overview() { return the<PictureView>("overview"); }
    static double lengthIn(const PictureView* view) { return view->calliper().value().lines.front().length(); }
    /// The picture itself shows the marker, a disc, where the line's first end is.
    static bool markerIsAtFirstEnd()
    {
        const QPointF at = overview()->calliper().value().lines.front().p1();
        const QColor color = overview()->image().pixelColor(int(at.x()), int(at.y()));
        return color.red() > 150 && color.green() < 100 && color.blue() < 100;
    }
    /// As a ball under the hand, to the right and down.
    static void turn(double right_rad, double down_rad)
    {
        const double ball_px = std::min(overview()->width(), overview()->height()) / 2.0;
        constexpr int kParts = 8;
        const QPoint from(overview()->width() / 2, overview()->height() - 40);  // away from the line's ends
        const QPointF by = QPointF(right_rad, down_rad) * ball_px;
        QPoint done;
        for (int n = 1; n <= kParts; ++n) {
            const QPoint part = (by * n / kParts).toPoint() - done;
            hold("overview", from, from + part);
            letGo("overview", from + part);
            done += part;
        }
        waitUntilQuiet();
    }
    /// The model as it is seen from the front: turned there and back.
    static void toModel()
    {
        turn(0.5, 0);
        turn(-0.5, 0);
    }

    const test::TestColon colon_;
    double behind_mm_ = 0;
};

TEST_F(MeasuredProjection, FromTheFrontALineInItsPlaneHasItsEndsAndItsValue)
{
    show(along);
    screenshot("projection_measured");
    const Calliper line = overview()->calliper().value();
    EXPECT_TRUE(line.grips[0] && line.grips[1]);
    EXPECT_FALSE(line.dashed);
    EXPECT_EQ(line.text, QString("%1 mm").arg(straight(), 0, 'f', 1));
    EXPECT_TRUE(markerIsAtFirstEnd());
    EXPECT_GE(calliperBetween("overview", endIn("overview", 0), endIn("overview", 1)), 0.9);
    key(Qt::Key_Escape);
    EXPECT_TRUE(eventually([] { return !overview()->calliper(); }));
}

TEST_F(MeasuredProjection, ALineThatIsSeenAtASlantIsDashedAndSaysItsValueInSpace)
{
    show(through);
    screenshot("projection_measured_through");
    const Calliper line = overview()->calliper().value();
    EXPECT_LT(lengthIn(overview()), 2) << "straight to the back";
    EXPECT_TRUE(line.dashed);
    EXPECT_EQ(line.text, QString("%1 mm, foreshortened").arg(stored()[1].size->straight_mm, 0, 'f', 1));
    EXPECT_TRUE(line.grips[0] && line.grips[1]) << "it is translucent";
}

TEST_F(MeasuredProjection, TheLineTurnsWithTheModelAsMuchShorterAsItIsSeenAtASlant)
{
    show(along);
    toModel();
    screenshot("model_measured");
    EXPECT_TRUE(markerIsAtFirstEnd());
    EXPECT_FALSE(overview()->calliper().value().dashed);
    const double whole_px = lengthIn(overview());
    constexpr double kTurned_rad = 0.7;
    turn(kTurned_rad, 0);
    screenshot("model_measured_at_a_slant");
    EXPECT_TRUE(markerIsAtFirstEnd());
    EXPECT_NEAR(lengthIn(overview()) / whole_px, std::cos(kTurned_rad), 0.03);
    EXPECT_TRUE(overview()->calliper().value().dashed);
    EXPECT_EQ(overview()->calliper()->text, QString("%1 mm, foreshortened").arg(straight(), 0, 'f', 1));
    key(Qt::Key_Z);
    EXPECT_TRUE(eventually([] { return overview()->calliper() && !overview()->calliper()->dashed; }))
        << "from the front";
}

TEST_F(MeasuredProjection, EndsBehindTheModelHaveNoGrip)
{
    show(through);
    toModel();
    EXPECT_TRUE(overview()->calliper().value().grips[0]);
    EXPECT_FALSE(overview()->calliper().value().grips[1]) << "behind the wall in front";
    show(along);
    EXPECT_TRUE(overview()->calliper().value().grips[0] && overview()->calliper().value().grips[1]);
    turn(0, std::numbers::pi);
    screenshot("model_measured_from_behind");
    EXPECT_FALSE(overview()->calliper().value().grips[0] || overview()->calliper().value().grips[1]);
    EXPECT_TRUE(overview()->calliper()->text.contains("behind other wall"));
    EXPECT_FALSE(markerIsAtFirstEnd()) << "its ring";
}

TEST_F(MeasuredProjection, AnEndIsDraggedOnTheModelByTheWallUnderTheMouse)
{
    show(along);
    toModel();
    turn(0.4, 0.2);
    isDraggedAndUndone("overview", 1, QPoint(-14, 2));
    drag("overview", endIn("overview", 1), endIn("overview", 1) + QPoint(-14, 2));
    const double before = straight();
    ASSERT_TRUE(eventually([&] { return straight() != before && settled(); })) << said().toStdString() << warning();
    const MarkerSize size = stored()[0].size.value();
    EXPECT_TRUE(size.along_mm) << "over the wall";
    EXPECT_LT(size.to_mm.y, (size.from_mm.y + behind_mm_) / 2) << "on the side that is seen";
}

TEST_F(MeasuredProjection, AnEndThatIsLetGoBesideTheModelStaysWhereItWas)
{
    show(along);
    toModel();
    const Calliper line = overview()->calliper().value();
    const double before = straight();
    drag("overview", endIn("overview", 1), QPoint(20, overview()->height() / 2));
    EXPECT_TRUE(eventually([] { return said().contains("No wall"); })) << said().toStdString();
    waitUntilQuiet();
    EXPECT_EQ(overview()->calliper().value().grips, line.grips);
    EXPECT_EQ(overview()->calliper()->text, line.text);
    EXPECT_EQ(straight(), before);
}

TEST_F(MeasuredProjection, FromTheFrontNoEndIsDraggedAndAWordSaysWhy)
{
    show(along);
    const Calliper line = overview()->calliper().value();
    const Pictures pictures = shownPictures();
    const double before = straight();
    drag("overview", endIn("overview", 1), endIn("overview", 1) + QPoint(-14, 2));
    EXPECT_TRUE(eventually([] { return warning().find("no depth") != std::string::npos; })) << warning();
    waitUntilQuiet();
    screenshot("projection_drag_refused");
    EXPECT_EQ(overview()->calliper().value().grips, line.grips);
    EXPECT_EQ(straight(), before);
    EXPECT_EQ(changedSince(pictures), "");
}

TEST_F(MeasuringBeside, WhatIsMeasuredInTheOtherScanIsDrawnOnItsProjectionAloneAndNotDraggedThere)
{
    const QPoint first = middle("besideAxial") + QPoint(-30, 30);
    measuredBetween("besideAxial", first, first + QPoint(60, 0));
    waitUntilQuiet();
    screenshot("projection_beside_measured");
    EXPECT_FALSE(the<PictureView>("overview")->calliper()) << "that is of the scan that is read";
    auto* view = the<PictureView>("besideOverview");
    const Calliper line = view->calliper().value();
    EXPECT_FALSE(line.dashed) << "from one side of the patient to the other";
    EXPECT_TRUE(said().startsWith(line.text)) << line.text.toStdString() << said().toStdString();
    drag("besideOverview", endIn("besideOverview", 1), endIn("besideOverview", 1) + QPoint(20, 0));
    EXPECT_TRUE(eventually([] { return warning().find("no depth") != std::string::npos; })) << warning();
    waitUntilQuiet();
    EXPECT_EQ(view->calliper().value().grips, line.grips);
}

}  // namespace
}  // namespace vicon::viewer
