// What a right click in a picture offers: a reader's mouse need not leave it.
#include <QAction>
#include <QMenu>

#include "reading.h"
#include "slices/slice_view.h"

namespace vicon::viewer {
namespace {

using test::Reading;

class PictureMenu : public Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        openCase();
        waitUntilQuiet();
    }
    static QMenu* menu() { return window()->findChild<QMenu*>("pictureMenu"); }
    static QMenu* openMenu(const char* view)
    {
        const QPoint at = middle(view);
        QTest::mouseMove(the<QWidget>(view), at);
        QTest::mouseClick(the<QWidget>(view), Qt::RightButton, {}, at);
        EXPECT_TRUE(eventually([] { return menu() && menu()->isVisible(); })) << view;
        return menu();
    }
    static void clickOn(QMenu* menu, QAction* action)
    {
        const QPoint at = menu->actionGeometry(action).center();
        QTest::mouseMove(menu, at);
        QTest::mouseClick(menu, Qt::LeftButton, {}, at);
    }
    static QAction* actionIn(const QMenu* menu, const QString& title)
    {
        for (QAction* action : menu->actions())
            if (action->text().remove('&') == title)
                return action;
        return nullptr;
    }
    /// @param within the submenu that it is in; none: the first level
    static void choose(const char* view, const QString& title, const QString& within = {})
    {
        QMenu* shown = openMenu(view);
        if (!within.isEmpty()) {
            QAction* other = actionIn(shown, within);
            ASSERT_NE(other, nullptr) << within.toStdString();
            clickOn(shown, other);
            shown = other->menu();
            ASSERT_TRUE(eventually([&] { return shown->isVisible(); }));
        }
        QAction* action = actionIn(shown, title);
        ASSERT_NE(action, nullptr) << title.toStdString();
        clickOn(shown, action);
        ASSERT_TRUE(eventually([] { return menu() == nullptr; })) << title.toStdString();
    }
};

TEST_F(PictureMenu, FliesReversesAndMarksWithoutLeavingTheView)
{
    const double began = station();
    choose("endoscopic", "Fly or stop");
    EXPECT_TRUE(eventually([&] { return station() > began + 20; }));
    choose("endoscopic", "Fly or stop");
    waitUntilAtRest();
    const double stopped = station();
    choose("endoscopic", "Reverse the flight");
    choose("endoscopic", "Fly or stop");
    EXPECT_TRUE(eventually([&] { return station() < stopped - 10; }));
    choose("endoscopic", "Fly or stop");
    waitUntilAtRest();
    choose("endoscopic", "Red marker at the next click", "Edit");
    click("endoscopic", middle("endoscopic"));
    EXPECT_TRUE(eventually([&] { return stored().size() == 1; }));
    openMenu("endoscopic")->grab().save(VICON_SCREENSHOTS "/picture_menu.png");
    screenshotNow("picture_menu_window");
}

TEST_F(PictureMenu, OfASliceBeginsWithSlicesAndADragWithTheRightButtonOpensNone)
{
    const auto* slice = the<SliceView>("axial");
    QAction* follow = actionIn(openMenu("axial"), "Follow the lumen (cine: Space)");
    ASSERT_NE(follow, nullptr);
    const bool followed = follow->isChecked();
    clickOn(menu(), follow);
    ASSERT_TRUE(eventually([] { return menu() == nullptr; }));
    EXPECT_NE(follow->isChecked(), followed);
    waitUntilQuiet();
    const Point3 before = slice->shown().pointAt({0, 0});
    const QPoint from = middle("axial");
    drag("axial", from, from + QPoint(40, 10), Qt::RightButton);
    waitUntilQuiet();
    EXPECT_EQ(menu(), nullptr);
    EXPECT_GT(distance(slice->shown().pointAt({0, 0}), before), 1) << "it pans";
}

}  // namespace
}  // namespace vicon::viewer
