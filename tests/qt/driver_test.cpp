// The reading room where OpenGL does not work; the program is started with a driver that cannot be loaded.
#include <gmock/gmock.h>

#include <QLabel>
#include <QTableWidget>

#include "reading.h"

namespace vicon::viewer {
namespace {

using WithoutOpenGl = test::Reading;

TEST_F(WithoutOpenGl, TheWindowSaysSoAndTheSlicesCanBeReadAndMarked)
{
    startOpening();
    ASSERT_TRUE(eventually([] { return !warning().empty(); }));
    EXPECT_THAT(warning(), testing::HasSubstr("OpenGL"));
    ASSERT_TRUE(eventually([] { return !the<QLabel>("where")->text().isEmpty() && drawn("coronal"); }));
    screenshot("no_opengl");
    key(Qt::Key_End);
    EXPECT_TRUE(eventually([] { return length() - station() < 2; }));
    settle();
    click("transverse", middle("transverse"));  // the slices still go where one clicks
    settle();
    key(Qt::Key_Home);
    EXPECT_TRUE(eventually([] { return station() < 2; }));
    auto* overview = the<QWidget>("overview");
    click("overview", overview->rect().center());
    settle();
    closeCase();
}

}  // namespace
}  // namespace vicon::viewer
