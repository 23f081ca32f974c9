// The ends of a measured line, dragged by the mouse in each view that shows it.
#include "measuring.h"

namespace vicon::viewer {
namespace {

using test::Measuring;
using test::MeasuringBeside;
using test::Outlining;

class Dragging : public Measuring {};

TEST_F(Dragging, InASlab)
{
    zoom("coronal", 4);
    key(Qt::Key_Y);
    waitUntilQuiet();
    const QPoint first = middle("coronal") + QPoint(-20, 0);
    measureIn("coronal", first, first + QPoint(40, 0));
    isDraggedAndUndone("coronal", 1, QPoint(40, 0), kMouse_px);
    const double before = straight();
    const QPoint end = endIn("coronal", 1);
    drag("coronal", end, end + QPoint(40, 0));
    ASSERT_TRUE(eventually([&] { return straight() != before && settled(); }));
    EXPECT_NEAR(straight(), 2 * before, 0.05 * before);
}

TEST_F(Dragging, OfAShortLineTheEndThatIsNearer)
{
    const QPoint first = middle("coronal") + QPoint(-20, 0);
    measureIn("coronal", first, first + QPoint(6, 0));
    isDraggedAndUndone("coronal", 1, QPoint(40, 0), kMouse_px);
    isDraggedAndUndone("coronal", 0, QPoint(-40, 0), kMouse_px);
}

TEST_F(Dragging, FromInside)
{
    const QPoint first = middle("endoscopic") + QPoint(70, 60);
    measureIn("endoscopic", first, first + QPoint(70, 0));
    EXPECT_TRUE(stored()[0].size->along_mm) << "over the wall";
    constexpr int kCloseBy_px = 50;  // this wall is close by: a millimetre is 25 pixels
    isDraggedAndUndone("endoscopic", 1, QPoint(90, 30), kCloseBy_px);
    isDraggedAndUndone("endoscopic", 0, QPoint(-80, 40), kCloseBy_px);
}

TEST_F(Dragging, OnTheCube)
{
    key(Qt::Key_U);
    ASSERT_TRUE(eventually([] { return the<QWidget>("cube")->isVisible() && drawn("cube"); }));
    waitUntilQuiet();
    const QPoint front(the<QWidget>("cube")->width() * 3 / 8, the<QWidget>("cube")->height() / 2);
    measureIn("cube", front + QPoint(20, 30), front + QPoint(45, 30));
    isDraggedAndUndone("cube", 1, QPoint(30, 0));
}

TEST_F(Dragging, InTheBand)
{
    key(Qt::Key_B, Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return the<QWidget>("band")->isVisible() && drawn("band"); }));
    waitUntilQuiet();
    const QPoint first = middle("band") + QPoint(10, 10);
    measureIn("band", first, first + QPoint(25, 0));
    isDraggedAndUndone("band", 1, QPoint(25, 0));
}

class DraggingBeside : public MeasuringBeside {};

TEST_F(DraggingBeside, InTheOtherScansSlice)
{
    const QPoint first = middle("besideAxial") + QPoint(-30, 30);
    measureIn("besideAxial", first, first + QPoint(60, 0));
    isDraggedAndUndone("besideAxial", 1, QPoint(40, 10));
    EXPECT_EQ(stored()[0].scan_id, test::kProne);
}

TEST_F(DraggingBeside, OnTheOtherScansWallFromInside)
{
    const QPoint first = middle("besideEndoscopic") + QPoint(40, 50);
    measureIn("besideEndoscopic", first, first + QPoint(30, 0));
    isDraggedAndUndone("besideEndoscopic", 1, QPoint(40, 0));
    EXPECT_EQ(stored()[0].scan_id, test::kProne);
}

class DraggingOutlines : public Outlining {
protected:
    void outline()
    {
        key(Qt::Key_M, Qt::ShiftModifier);
        click("endoscopic", middle("endoscopic"));
        ASSERT_TRUE(eventually([&] { return outlined().has_value() && settled(); })) << said().toStdString();
        waitUntilQuiet();
    }
};

TEST_F(DraggingOutlines, FromInside)
{
    outline();
    EXPECT_FALSE(the<PictureView>("endoscopic")->calliper().value().rim.isEmpty());
    isDraggedAndUndone("endoscopic", 1, QPoint(40, 20));
    isDraggedAndUndone("endoscopic", 0, QPoint(-30, 30));
}

TEST_F(DraggingOutlines, InASlice)
{
    outline();
    zoom("coronal", 4);
    const auto shown = [] {
        const auto& calliper = the<PictureView>("coronal")->calliper();
        return calliper && (calliper->grips[0] || calliper->grips[1]);
    };
    for (int n = 0; n < 12 && !shown(); ++n)
        scroll("coronal", 1);
    ASSERT_TRUE(shown()) << "the slice of an end";
    isDraggedAndUndone("coronal", the<PictureView>("coronal")->calliper()->grips[0] ? 0 : 1, QPoint(30, 20), kMouse_px);
}

TEST_F(Dragging, AnEndThatIsLetGoWhereNoWallIsStaysWhereItWas)
{
    key(Qt::Key_U);
    ASSERT_TRUE(eventually([] { return the<QWidget>("cube")->isVisible() && drawn("cube"); }));
    waitUntilQuiet();
    const QPoint front(the<QWidget>("cube")->width() * 3 / 8, the<QWidget>("cube")->height() / 2);
    measureIn("cube", front + QPoint(20, 30), front + QPoint(45, 30));
    const double before = straight();
    const Calliper line = the<PictureView>("cube")->calliper().value();
    const QPoint beside_the_cube(8, 8);
    drag("cube", endIn("cube", 1), beside_the_cube);
    EXPECT_TRUE(eventually([] { return said().contains("No wall"); })) << said().toStdString();
    waitUntilQuiet();
    const auto& now = the<PictureView>("cube")->calliper();
    ASSERT_TRUE(now);
    EXPECT_EQ(now->grips, line.grips);
    EXPECT_EQ(now->text, line.text);
    EXPECT_EQ(straight(), before);
    isDraggedAndUndone("cube", 1, QPoint(30, 0));
}

}  // namespace
}  // namespace vicon::viewer
