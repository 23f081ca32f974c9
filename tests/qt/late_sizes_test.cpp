// A size that takes a while: what the reader does meanwhile, and drags that come to nothing.
#include <QLineEdit>
#include <algorithm>

#include "measuring.h"
#include "vicon/cases/finding_facts.h"

namespace vicon::viewer {
namespace {

using test::Measuring;
using test::Outlining;

/// Two findings far from each other, each with a marker and a size. The mouse's events follow each other so fast that
/// nothing can come from another thread between them.
class LateSizes : public Measuring {
protected:
    enum Row { first, second };
    static constexpr double kFirst_mm = 60, kSecond_mm = 150, kSize_mm = 5;

    void SetUp() override
    {
        Reading::SetUp();
        for (const double station_mm : {kFirst_mm, kSecond_mm}) {
            const Point3 from = wallAt(station_mm);
            saveMeasured(store_, colon_, from,
                         nearestOnWall([&](Point3 p) { return std::abs(distance(p, from) - kSize_mm); }));
        }
        prepare();
        openCase();
        window()->resize(1600, 1000);
        waitUntilQuiet();
    }
    virtual void prepare() {}

    template <class Far>
    Point3 nearestOnWall(Far far) const
    {
        Point3 best = colon_.cells.point(0);
        for (std::size_t n = 1; n < colon_.cells.pointCount(); ++n)
            if (const Point3 p = colon_.cells.point(n); far(p) < far(best))
                best = p;
        return best;
    }
    Point3 wallAt(double station_mm) const
    {
        const Point3 middle = colon_.skeleton.at(station_mm).position_mm;
        return nearestOnWall([&](Point3 p) { return distance(p, middle); });
    }
    static void show(Row row)
    {
        clickRow(markers(), row);
        waitUntilQuiet();
        ASSERT_TRUE(the<PictureView>("endoscopic")->calliper());
    }
    double sizeOf(Row row) const { return stored()[std::size_t(row)].size.value().straight_mm; }
    /// What stands at the line in each view that draws it.
    static std::map<QString, QString> lengthsShown()
    {
        std::map<QString, QString> lengths;
        for (const PictureView* view : window()->findChildren<PictureView*>())
            if (view->isVisible() && view->calliper())
                lengths[view->objectName()] = view->calliper()->text;
        return lengths;
    }
    /// Of the line that is shown, over the wall.
    static void dragEndFromInside()
    {
        const QPoint end = endIn("endoscopic", 1);
        drag("endoscopic", end, end + (end - endIn("endoscopic", 0)) / 2);
    }

    const test::TestColon colon_;
};

TEST_F(LateSizes, ADraggedSizeIsKeptWithItsMarkerThoughAnotherIsChosenBeforeItIsThere)
{
    show(second);
    const auto lengths = lengthsShown();
    show(first);
    const double before = sizeOf(first), of_other = sizeOf(second);
    dragEndFromInside();
    clickRow(markers(), second);
    ASSERT_TRUE(eventually([&] { return sizeOf(first) != before && settled(); })) << said().toStdString() << warning();
    screenshot("late_size_of_another");
    EXPECT_EQ(sizeOf(second), of_other);
    EXPECT_TRUE(said().contains("kept with m1")) << said().toStdString();
    EXPECT_EQ(lengthsShown(), lengths) << "the one that was chosen";
    key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_TRUE(eventually([&] { return sizeOf(first) == before && settled(); }));
}

TEST_F(LateSizes, EscGivesUpWhatIsMeasuredAndTheSizeStays)
{
    show(first);
    const double before = sizeOf(first);
    dragEndFromInside();
    key(Qt::Key_Escape);
    waitUntilQuiet();
    EXPECT_EQ(sizeOf(first), before);
    EXPECT_TRUE(lengthsShown().empty());
}

TEST_F(LateSizes, ADragThatAnotherButtonBreaksOffLeavesTheSizeInAllViews)
{
    show(first);
    const double before = sizeOf(first);
    const auto lengths = lengthsShown();
    const QPoint end = endIn("endoscopic", 1), to = end + (end - endIn("endoscopic", 0)) / 2;
    hold("endoscopic", end, to);
    ASSERT_NE(lengthsShown(), lengths) << "while it is dragged";
    QTest::mousePress(the<QWidget>("endoscopic"), Qt::RightButton, {}, to);
    EXPECT_TRUE(said().contains("broken off")) << said().toStdString();
    QTest::mouseRelease(the<QWidget>("endoscopic"), Qt::RightButton, {}, to);
    letGo("endoscopic", to);
    waitUntilQuiet();
    screenshot("drag_broken_off");
    EXPECT_EQ(lengthsShown(), lengths);
    EXPECT_EQ(endIn("endoscopic", 1), end);
    EXPECT_EQ(sizeOf(first), before);
    EXPECT_EQ(QApplication::activePopupWidget(), nullptr) << "the other button's menu";
    dragEndFromInside();
    EXPECT_TRUE(eventually([&] { return sizeOf(first) != before && settled(); })) << said().toStdString();
}

TEST_F(LateSizes, AnEndThatIsDraggedOntoTheOtherLeavesTheSize)
{
    show(first);
    const double before = sizeOf(first);
    const auto lengths = lengthsShown();
    drag("endoscopic", endIn("endoscopic", 1), endIn("endoscopic", 0));
    EXPECT_TRUE(said().contains("stays as it was")) << said().toStdString();
    waitUntilQuiet();
    EXPECT_EQ(sizeOf(first), before);
    EXPECT_EQ(lengthsShown(), lengths);
}

/// A note is written in the list meanwhile; the mouse in a picture leaves the keyboard there.
class LateSizesAndNotes : public LateSizes {
protected:
    static QLineEdit* beginNote()
    {
        key(Qt::Key_N);
        auto* editor = markers()->findChild<QLineEdit*>();
        EXPECT_NE(editor, nullptr);
        return editor;
    }
};

TEST_F(LateSizesAndNotes, ANoteIsWrittenOnWhileASizeIsKeptAndOnlySavedWhenItIsDone)
{
    show(first);
    double before = sizeOf(first);
    dragEndFromInside();
    auto* editor = beginNote();
    QTest::keyClicks(editor, "ses");
    ASSERT_TRUE(eventually([&] { return sizeOf(first) != before; })) << said().toStdString() << warning();
    waitUntilQuiet();
    screenshot("note_written_on");
    EXPECT_EQ(stored()[first].note, "");
    ASSERT_EQ(markers()->findChild<QLineEdit*>(), editor);
    EXPECT_EQ(editor->text(), "ses");
    EXPECT_EQ(cell(first, 5), QString::number(largestDiameter_mm(stored()[first].size.value()), 'f', 1));
    EXPECT_EQ(warning(), "");
    QTest::keyClicks(editor, "sile");
    QTest::keyClick(editor, Qt::Key_Return);
    ASSERT_TRUE(eventually([&] { return stored()[first].note == "sessile" && settled(); })) << warning();
    waitUntilQuiet();
    before = sizeOf(first);
    dragEndFromInside();
    editor = beginNote();
    QTest::keyClicks(editor, "no");
    ASSERT_TRUE(eventually([&] { return sizeOf(first) != before; })) << said().toStdString() << warning();
    waitUntilQuiet();
    QTest::keyClick(editor, Qt::Key_Escape);
    waitUntilQuiet();
    EXPECT_EQ(stored()[first].note, "sessile");
    EXPECT_EQ(cell(first, 6), "sessile");
    EXPECT_EQ(warning(), "");
}

TEST_F(LateSizesAndNotes, ANoteThatIsDoneBeforeTheSizeIsSavedLosesNeither)
{
    show(first);
    const double before = sizeOf(first);
    auto* editor = beginNote();
    QTest::keyClicks(editor, "sessile");
    const QPoint end = endIn("coronal", 0);
    drag("coronal", end, end + QPoint(25, 15));
    EXPECT_EQ(editor->text(), "sessile");
    clickRow(markers(), second);  // the note is done
    EXPECT_TRUE(eventually([&] { return stored()[first].note == "sessile" && sizeOf(first) != before && settled(); }))
        << said().toStdString() << warning();
    waitUntilQuiet();
    EXPECT_EQ(warning(), "");
    EXPECT_EQ(cell(first, 6), "sessile");
}

/// Between the ends of its first size the wall is cut through.
class CutWall : public LateSizes {
protected:
    void prepare() override
    {
        constexpr double kCut_mm = 75, kWide_mm = 3;
        test::TestColon cut = colon_;
        std::vector<bool> gone(cut.cells.pointCount());
        for (std::size_t n = 0; n < gone.size(); ++n)
            gone[n] = std::abs(cut.skeleton.nearest(cut.cells.point(n)).station_mm - kCut_mm) < kWide_mm;
        CellSurface left;
        left.points_mm = cut.cells.points_mm;
        left.normals = cut.cells.normals;
        for (std::size_t t = 0; t < cut.cells.triangleCount(); ++t) {
            const auto* corner = &cut.cells.triangles[3 * t];
            if (std::none_of(corner, corner + 3, [&](std::uint32_t n) { return gone[n]; })) {
                left.triangles.insert(left.triangles.end(), corner, corner + 3);
                left.segment.push_back(cut.cells.segment[t]);
            }
        }
        cut.cells = left;
        cut.write(store_ / "cases" / test::kCase / test::kSupine);
        CaseStore store(store_);
        Marker marker = store.markers(test::kCase)[first];
        marker.size->to_mm = wallAt(kBehind_mm);
        marker.size->straight_mm = distance(marker.size->from_mm, marker.size->to_mm);
        store.editMarkers(test::kCase, {{store.markers(test::kCase)[first], marker}});
    }
    static constexpr double kBehind_mm = 88;
};

TEST_F(CutWall, ASizeThatCannotBeMeasuredAnewLeavesTheOneThatWasKept)
{
    key(Qt::Key_U);
    ASSERT_TRUE(eventually([] { return the<QWidget>("cube")->isVisible() && drawn("cube"); }));
    show(first);
    waitUntilQuiet();
    const double before = sizeOf(first);
    const auto lengths = lengthsShown();
    const QPoint end = endIn("cube", 0);
    drag("cube", end, end + QPoint(25, 0));
    EXPECT_TRUE(eventually([] { return warning().find("No way over the wall") != std::string::npos; }))
        << said().toStdString();
    waitUntilQuiet();
    screenshot("not_measured_anew");
    EXPECT_EQ(lengthsShown(), lengths);
    EXPECT_EQ(sizeOf(first), before);
}

TEST_F(Measuring, TwoClicksAtOnePlaceAreNoSizeAndTheOtherEndIsStillAwaited)
{
    for (const char* view : {"coronal", "endoscopic"}) {
        SCOPED_TRACE(view);
        const QPoint first = middle(view) + QPoint(30, 20);
        key(Qt::Key_M);
        click(view, first);
        click(view, first);
        EXPECT_TRUE(said().contains("place of the first end")) << said().toStdString();
        waitUntilQuiet();
        EXPECT_FALSE(said().contains("straight")) << said().toStdString();
        click(view, first + QPoint(80, 0));
        EXPECT_TRUE(eventually([] { return said().contains("straight"); })) << said().toStdString() << warning();
    }
}

/// The polyp has no marker yet.
class OutliningFirst : public Outlining {
protected:
    void SetUp() override
    {
        Outlining::SetUp();
        key(Qt::Key_Delete);
        ASSERT_TRUE(eventually([] { return markers()->rowCount() == 0 && settled(); }));
        waitUntilQuiet();
    }
    void keptWithMarker() const
    {
        ASSERT_TRUE(eventually([&] { return stored().size() == 1 && stored()[0].size && settled(); }))
            << said().toStdString() << warning();
        EXPECT_TRUE(said().contains("kept with m")) << said().toStdString();
        EXPECT_TRUE(the<PictureView>("endoscopic")->calliper());
    }
    static void takeBack()
    {
        for (const int left : {1, 0}) {
            key(Qt::Key_Z, Qt::ControlModifier);
            ASSERT_TRUE(eventually([&] { return markers()->rowCount() == left && settled(); }));
        }
        waitUntilQuiet();
    }
};

TEST_F(OutliningFirst, TheSizeIsKeptWithTheMarkerThatIsPlacedBeforeItIsThere)
{
    const QPoint on_polyp = middle("endoscopic");
    key(Qt::Key_M, Qt::ShiftModifier);
    click("endoscopic", on_polyp);
    click("endoscopic", on_polyp, Qt::ShiftModifier);
    keptWithMarker();
    EXPECT_TRUE(outlined());
    screenshot("marked_while_outlined");
    takeBack();
    key(Qt::Key_M, Qt::ShiftModifier);
    click("endoscopic", on_polyp);
    key(Qt::Key_2);
    click("endoscopic", on_polyp);
    keptWithMarker();
    EXPECT_TRUE(outlined());
    takeBack();
    key(Qt::Key_M);
    click("endoscopic", on_polyp);
    click("endoscopic", on_polyp + QPoint(60, 0));
    click("endoscopic", on_polyp, Qt::ShiftModifier);
    keptWithMarker();
    EXPECT_TRUE(stored()[0].size->along_mm);
}

TEST_F(OutliningFirst, AMarkerIsMovedWhileAnotherIsOutlined)
{
    const QPoint on_polyp = middle("endoscopic"), beside = on_polyp + QPoint(150, 80);
    click("endoscopic", on_polyp, Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
    click("endoscopic", beside, Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 2 && settled(); }));
    clickRow(markers(), 1);
    waitUntilQuiet();
    key(Qt::Key_M, Qt::ShiftModifier);
    click("coronal", placeIn("coronal", colon_.polyp_mm));
    press(window(), "markerMove");
    click("coronal", placeIn("coronal", stored()[1].position_mm) + QPoint(4, 0));
    EXPECT_TRUE(eventually([&] { return stored()[0].size && settled(); })) << said().toStdString() << warning();
}

TEST_F(Outlining, WhatCannotBeOutlinedIsOnlySaidWhereAnotherMarkerIsChosenMeanwhile)
{
    key(Qt::Key_M, Qt::ShiftModifier);
    click("endoscopic", middle("endoscopic"));
    ASSERT_TRUE(eventually([&] { return outlined().has_value() && settled(); })) << said().toStdString() << warning();
    key(Qt::Key_Home);
    ASSERT_TRUE(eventually([] { return station() < 2 && pictureIsThere(); }));
    waitUntilQuiet();
    key(Qt::Key_M, Qt::ShiftModifier);
    click("endoscopic", middle("endoscopic") + QPoint(90, 60));
    clickRow(markers(), 0);
    ASSERT_TRUE(eventually([] { return warning().find("cannot be outlined") != std::string::npos; })) << warning();
    EXPECT_EQ(warning().find("Click on its two ends"), std::string::npos) << warning();
    waitUntilQuiet();
    click("coronal", middle("coronal"));
    EXPECT_FALSE(said().contains("other end")) << "no click is awaited: " << said().toStdString();
}

}  // namespace
}  // namespace vicon::viewer
