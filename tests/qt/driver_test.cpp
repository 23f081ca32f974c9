// The reading room where OpenGL does not work: its driver cannot be loaded.
#include <gmock/gmock.h>

#include <QLabel>
#include <QTableWidget>

#include "reading.h"

namespace vicon::viewer {
namespace {

class WithoutOpenGl : public test::Reading {
protected:
    /// The X server has begun before; only this program lacks the driver.
    static void SetUpTestSuite()
    {
        test::Reading::SetUpTestSuite();
        qputenv("LIBGL_DRIVERS_PATH", "/nonexistent");
        qputenv("GBM_BACKENDS_PATH", "/nonexistent");
    }
};

TEST_F(WithoutOpenGl, TheWindowSaysSoAndTheCaseCanBeReadAndMarked)
{
    openCase();
    EXPECT_THAT(warning(), testing::HasSubstr("OpenGL does not work here"));
    screenshot("no_opengl");
    key(Qt::Key_End);
    EXPECT_TRUE(eventually([] { return length() - station() < 2; }));
    key(Qt::Key_Home);
    EXPECT_TRUE(eventually([] { return station() < 2 && pictureIsThere(); }));
    click("endoscopic", middle("endoscopic") + QPoint(90, 60), Qt::ShiftModifier);
    ASSERT_TRUE(eventually([] { return markers()->rowCount() == 1 && settled(); })) << warning();
    EXPECT_EQ(stored().size(), 1U);
    EXPECT_EQ(the<QLabel>("seenText")->text(), "0.0 % seen") << "what is cast does not count";
    closeCase();
}

}  // namespace
}  // namespace vicon::viewer
