#pragma once

#include <QMessageBox>
#include <QMouseEvent>
#include <QPushButton>
#include <QTableWidget>
#include <QWheelEvent>
#include <cmath>
#include <map>
#include <optional>

#include "reading.h"
#include "slices/slice_view.h"
#include "test_colon.h"
#include "vicon/cases/case_store.h"
#include "widgets/picture_view.h"

namespace vicon::viewer::test {

inline const QColor kCalliper(255, 214, 102);

/// A marker of the supine scan with a size over the wall, as an earlier reading left it.
inline void saveMeasured(const std::filesystem::path& store, const TestColon& colon, Point3 from, Point3 to)
{
    Marker marker;
    marker.scan_id = kSupine;
    marker.position_mm = from;
    marker.station_mm = colon.skeleton.nearest(from).station_mm;
    marker.size = MarkerSize{};
    marker.size->straight_mm = marker.size->along_mm.emplace(distance(from, to));
    marker.size->from_mm = from;
    marker.size->to_mm = to;
    CaseStore(store).saveMarker(kCase, marker);
}

/// Lengths in slices and on the wall, by the mouse.
class Measuring : public Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        openCase();
        window()->resize(1600, 1000);
        waitUntilQuiet();
    }
    /// One red marker where the eye looks.
    void mark()
    {
        click("endoscopic", middle("endoscopic") + QPoint(90, 60), Qt::ShiftModifier);
        ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
        waitUntilQuiet();
    }
    static void zoom(const char* view, int notches) { scroll(view, notches, Qt::ControlModifier); }
    static void scroll(const char* view, int notches, Qt::KeyboardModifiers modifiers = {})
    {
        auto* widget = the<QWidget>(view);
        const QPointF at = widget->rect().center();
        QWheelEvent event(at, widget->mapToGlobal(at.toPoint()), {}, {0, 120 * notches}, Qt::NoButton, modifiers,
                          Qt::NoScrollPhase, false);
        QApplication::sendEvent(widget, &event);
        waitUntilQuiet();
    }
    static bool yellow(const QColor& c)
    {
        constexpr int kOff = 24;
        return std::abs(c.red() - kCalliper.red()) < kOff && std::abs(c.green() - kCalliper.green()) < kOff &&
               std::abs(c.blue() - kCalliper.blue()) < kOff;
    }
    /// Pixels of a calliper along the straight line between two places of a view, as a share.
    static double calliperBetween(const char* view, QPoint a, QPoint b)
    {
        const QImage image = pictureOf(view);
        constexpr int kSteps = 40;
        int hits = 0;
        for (int n = 0; n <= kSteps; ++n) {
            const QPoint p = a + (b - a) * n / kSteps;
            bool near = false;
            for (int y = -2; y <= 2; ++y)
                for (int x = -2; x <= 2; ++x)
                    near = near || (image.valid(p + QPoint(x, y)) && yellow(image.pixelColor(p + QPoint(x, y))));
            hits += near;
        }
        return double(hits) / (kSteps + 1);
    }
    static double firstLength(const QString& text) { return text.section(' ', 0, 0).toDouble(); }
    /// What the window says was measured between two clicks.
    static double measuredBetween(const char* view, QPoint a, QPoint b)
    {
        key(Qt::Key_M);
        click(view, a);
        click(view, b);
        EXPECT_TRUE(eventually([] { return said().contains("straight"); })) << said().toStdString();
        return firstLength(said());
    }
    static void answer(const char* button)
    {
        ASSERT_TRUE(eventually([] { return window()->findChild<QMessageBox*>("replaceSize") != nullptr; }));
        QTest::mouseClick(the<QPushButton>(button), Qt::LeftButton);
        window()->activateWindow();
        ASSERT_TRUE(eventually([] { return window()->isActiveWindow() && settled(); }));
    }
    double straight() const { return stored()[0].size.value().straight_mm; }

    /// Where a view shows an end of the line, in the widget.
    static QPoint endIn(const char* view, std::size_t which)
    {
        const auto* picture = the<PictureView>(view);
        if (!picture->calliper() || !picture->calliper()->grips[which]) {
            ADD_FAILURE() << view << " shows no such end";
            return {};
        }
        const QPointF at = *picture->calliper()->grips[which];
        return picture->toWidget({at.x(), at.y()}).toPoint();
    }
    /// The button goes down, and the mouse moves in steps.
    static void hold(const char* view, QPoint from, QPoint to)
    {
        auto* widget = the<QWidget>(view);
        QTest::mousePress(widget, Qt::LeftButton, {}, from);
        for (int n = 1; n <= 4; ++n) {
            const QPoint at = from + (to - from) * n / 4;
            QMouseEvent move(QEvent::MouseMove, at, widget->mapToGlobal(at), Qt::NoButton, Qt::LeftButton, {});
            QApplication::sendEvent(widget, &move);
        }
    }
    static void letGo(const char* view, QPoint at) { QTest::mouseRelease(the<QWidget>(view), Qt::LeftButton, {}, at); }

    /// Of all views that are shown, without the line over them.
    using Pictures = std::map<QString, QImage>;
    static Pictures shownPictures()
    {
        Pictures pictures;
        for (const PictureView* view : window()->findChildren<PictureView*>())
            if (view->isVisible())
                pictures[view->objectName()] = view->image();
        return pictures;
    }
    /// The names of the views whose pictures are others than these.
    static std::string changedSince(const Pictures& before)
    {
        const Pictures now = shownPictures();
        QStringList changed;
        for (const auto& [name, picture] : before)
            if (!now.count(name) || now.at(name) != picture)
                changed << name;
        return changed.join(' ').toStdString();
    }

    /// A marker at the first place, and a size from there to the second that is kept with it.
    void measureIn(const char* view, QPoint first, QPoint second)
    {
        click(view, first, Qt::ShiftModifier);
        ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); }));
        waitUntilQuiet();
        key(Qt::Key_M);
        click(view, first);
        click(view, second);
        ASSERT_TRUE(eventually([&] { return stored()[0].size.has_value() && settled(); }))
            << said().toStdString() << warning();
        waitUntilQuiet();
    }
    static constexpr int kMouse_px = 3;    // rounding: in a slice an end stays where the mouse left it
    static constexpr int kCorner_px = 16;  // on the wall it goes to the nearest corner of this coarse one
    /// The end of the size that is shown goes where the mouse lets it go: meanwhile and afterwards no view moves, it is
    /// measured anew and kept, and one undo brings the old line back.
    void isDraggedAndUndone(const char* view, std::size_t end, QPoint by, int off_px = kCorner_px)
    {
        SCOPED_TRACE(view);
        waitUntilQuiet();
        const MarkerSize before = stored()[0].size.value();
        const Calliper line = the<PictureView>(view)->calliper().value();
        const Pictures pictures = shownPictures();
        const QPoint from = endIn(view, end), to = from + by;
        const auto isWithin = [&](int px) { return (endIn(view, end) - to).manhattanLength() <= px; };
        hold(view, from, to);
        EXPECT_TRUE(eventually([&] { return isWithin(kMouse_px); })) << "the line follows the mouse";
        waitUntilQuiet();
        EXPECT_EQ(changedSince(pictures), "") << "while it is dragged";
        EXPECT_EQ(straight(), before.straight_mm) << "nothing is kept before it is let go";
        letGo(view, to);
        ASSERT_TRUE(eventually([&] { return straight() != before.straight_mm && settled(); }))
            << said().toStdString() << warning();
        screenshot((std::string("dragged_") + view).c_str());
        EXPECT_TRUE(isWithin(off_px));
        EXPECT_EQ(changedSince(pictures), "") << "when it is let go";
        const MarkerSize after = stored()[0].size.value();
        EXPECT_FALSE(after.polyp) << "it is the reader's own";
        const auto otherOf = [end](const MarkerSize& size) { return end == 0 ? size.to_mm : size.from_mm; };
        EXPECT_LT(distance(otherOf(after), otherOf(before)), 1e-6);
        key(Qt::Key_Z, Qt::ControlModifier);
        ASSERT_TRUE(eventually([&] { return straight() == before.straight_mm && settled(); }));
        waitUntilQuiet();
        const auto& again = the<PictureView>(view)->calliper();
        ASSERT_TRUE(again);
        EXPECT_EQ(again->grips, line.grips);
        EXPECT_EQ(again->rim, line.rim);
        EXPECT_EQ(again->text, line.text);
        EXPECT_EQ(changedSince(pictures), "") << "when it is undone";
    }
};

/// With the other scan beside. Both show the same colon in the same place: what is drawn in the wrong one is seen.
class MeasuringBeside : public Measuring {
protected:
    void SetUp() override
    {
        Measuring::SetUp();
        key(Qt::Key_C);
        ASSERT_TRUE(
            eventually([] { return drawn("besideAxial") && drawn("besideEndoscopic") && drawn("besideOverview"); }));
        waitUntilQuiet();
    }
};

/// A marker on the polyp of the colon is there from the beginning.
class Outlining : public Measuring {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        colon_.write(store_ / "cases" / kCase / kSupine);
        Marker marker;
        marker.scan_id = kSupine;
        const auto nearest = [&](Point3 p) { return path_.at(path_.nearest(p).station_mm).position_mm; };
        const Vector3 inwards = normalized(nearest(colon_.polyp_mm) - colon_.polyp_mm);
        marker.position_mm = colon_.polyp_mm + inwards * colon_.polyp_radius_mm;
        marker.station_mm = colon_.polyp_station_mm;
        CaseStore(store_).saveMarker(kCase, marker);
        openCase();
        window()->resize(1600, 1000);
        waitUntilQuiet();
        clickRow(markers(), 0);
        ASSERT_TRUE(eventually([] { return pictureIsThere(); }));
        waitUntilQuiet();
    }
    std::optional<PolypSize> outlined() const { return stored()[0].size ? stored()[0].size->polyp : std::nullopt; }

    /// Where a slice shows a point of the scan, or what lies before or behind it.
    static QPoint placeIn(const char* view, Point3 p)
    {
        const Pixel at = the<SliceView>(view)->shown().toPixel(p);
        return {int(at.x), int(at.y)};
    }

    static constexpr double kVoxel_mm = 1;
    const TestColon colon_{storages().front(), kVoxel_mm};
    const Skeleton& path_ = colon_.skeleton;
};

}  // namespace vicon::viewer::test
