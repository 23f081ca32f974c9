// The real scan read by keyboard alone on three screens, from inside first and in slices first. Its pictures are there
// to be looked at; what is held here is that every view has room and nothing reaches beyond the screen.
#include <QDockWidget>
#include <QLineEdit>
#include <QPushButton>
#include <QStatusBar>
#include <QTableWidget>

#include "study_walk.h"

namespace vicon::viewer::test {
namespace {

constexpr int kLeastSide_px = 160;  // of a picture that is still worth looking at

class OnScreen : public StudyReader, public testing::WithParamInterface<QSize> {
protected:
    void SetUp() override
    {
        VICON_NEEDS_DATA("ctc-prone");
        patience_ms = kPatience_ms;
        const std::string size = std::to_string(GetParam().width());
        openStore(preparedStore("scan", support::sharedData("ctc-prone"), *folder_ / testName()), size);
        activate(room_.get(), cases());
        type(Qt::Key_Return);
        ASSERT_TRUE(eventually([] { return window() != nullptr; }));
        waitForScan();
        window()->resize(GetParam());
        ASSERT_TRUE(eventually([] { return window()->size() == GetParam(); })) << "it does not fit this screen";
        waitUntilQuiet();
    }
    void TearDown() override
    {
        StudyReader::TearDown();
        std::filesystem::remove_all(*folder_ / testName());
    }
    static std::string testName()
    {
        std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
        std::replace(name.begin(), name.end(), '/', '-');
        return name;
    }
    /// Its picture, and that it holds together.
    void look(const std::string& step, std::initializer_list<const char*> views)
    {
        waitUntilQuiet();
        screenshot(step);
        EXPECT_EQ(window()->size(), GetParam()) << step;
        for (const char* name : views) {
            const auto* view = the<QWidget>(name);
            ASSERT_TRUE(view->isVisible()) << step << ": " << name;
            EXPECT_GE(std::min(view->width(), view->height()), kLeastSide_px) << step << ": " << name;
            EXPECT_EQ(view->visibleRegion().boundingRect().size(), view->size()) << step << ": " << name << " is cut";
        }
    }
    static void jump(double station_mm)
    {
        type(Qt::Key_J);
        QTest::keyClicks(QApplication::focusWidget(), QString::number(station_mm, 'f', 0));
        type(Qt::Key_Return);
        ASSERT_TRUE(eventually([&] { return std::abs(station() - station_mm) < 2 && pictureIsThere(); })) << station();
    }
    bool has(int count) const
    {
        return eventually([&] { return markers()->rowCount() == count && settled(); });
    }
    bool isMeasured() const
    {
        return eventually([&] { return stored(case_id_.c_str()).back().size.has_value() && settled(); });
    }

    static constexpr int kPatience_ms = 120000;
    static constexpr double kPlace_mm = 600;
};

TEST_P(OnScreen, IsReadFromInsideFirstByKeyboardAlone)
{
    look("3d-opened", {"endoscopic", "axial", "coronal", "sagittal", "overview"});
    type(Qt::Key_Space);
    ASSERT_TRUE(eventually([] { return station() > 40; }));
    type(Qt::Key_Space);
    ASSERT_NO_FATAL_FAILURE(jump(kPlace_mm));
    type(Qt::Key_1);
    type(Qt::Key_Right);
    type(Qt::Key_Return);
    ASSERT_TRUE(has(1)) << warning();
    type(Qt::Key_M);
    type(Qt::Key_Return);
    type(Qt::Key_Right);
    type(Qt::Key_Return);
    ASSERT_TRUE(isMeasured()) << warning();
    look("3d-measured", {"endoscopic", "axial", "overview"});
    type(Qt::Key_Escape);
    type(Qt::Key_R, Qt::ControlModifier);
    ASSERT_TRUE(eventually([] { return the<QWidget>("reportForm")->isVisible(); }));
    look("3d-form", {"endoscopic", "axial", "reportForm"});
    type(Qt::Key_R, Qt::ControlModifier);
    ASSERT_TRUE(eventually([] { return !the<QWidget>("reportForm")->isVisible(); }));
    type(Qt::Key_F2);
    waitUntilQuiet();
    type(Qt::Key_F2);
    look("3d-back-in-one", {"endoscopic", "axial", "coronal", "sagittal", "overview"});
    closeCase();
}

TEST_P(OnScreen, IsReadInSlicesFirstByKeyboardAlone)
{
    type(Qt::Key_F6);
    look("2d-opened", {"endoscopic", "axial", "coronal", "sagittal", "overview"});
    ASSERT_NO_FATAL_FAILURE(jump(kPlace_mm));
    const double there = station();
    type(Qt::Key_Escape);
    for (int n = 0; n < 4; ++n)
        type(Qt::Key_PageUp);
    ASSERT_TRUE(eventually([&] { return station() > there + 1; })) << "the lumen is followed";
    waitUntilQuiet();
    type(Qt::Key_Return, Qt::ShiftModifier);
    ASSERT_TRUE(has(1)) << warning();
    type(Qt::Key_M);
    type(Qt::Key_Return);
    for (int n = 0; n < 3; ++n)
        type(Qt::Key_Right);
    type(Qt::Key_Return);
    ASSERT_TRUE(eventually([] { return window()->statusBar()->currentMessage().contains("straight"); })) << warning();
    look("2d-measured", {"axial"});
    type(Qt::Key_Escape);
    type(Qt::Key_H);
    look("2d-coronal", {"coronal", "axial", "sagittal"});
    type(Qt::Key_F8);
    look("2d-planes", {"endoscopic", "axial", "coronal", "sagittal"});
    type(Qt::Key_E);
    look("2d-alone", {"axial"});
    closeCase();
}

INSTANTIATE_TEST_SUITE_P(Real, OnScreen, testing::Values(QSize(1366, 738), QSize(1920, 1050), QSize(2560, 1410)),
                         [](const auto& screen) { return "At" + std::to_string(screen.param.width()); });

}  // namespace
}  // namespace vicon::viewer::test
