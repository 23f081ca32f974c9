// The reading room where OpenGL does not work: its driver cannot be loaded.
#include <gmock/gmock.h>

#include <QLabel>
#include <QTableWidget>

#include "reading.h"
#include "vicon/viewer/scene/reading_pictures.h"

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
    EXPECT_EQ(the<QLabel>("seenText")->text(), "0.0 % reviewed") << "what is cast does not count";
    closeCase();
}

TEST_F(WithoutOpenGl, OnlyWhatWasChosenIsPeeledAndSaidToBe)
{
    const auto scan = PreparedScan::open(store_ / "cases" / test::kCase / test::kSupine);
    const ViewPose view = poseAtStation(scan.frames(), scan.lumen(), 100, Heading::caecum);
    ReadingPictures pictures(scan);
    ASSERT_FALSE(pictures.hasOpenGl());
    SnapshotRequest request;
    request.width = request.height = 400;
    const auto picture = [&] {
        return pictures.endoscopic(request, {view.pose, view.station_mm, view.clearance_mm, true}, true);
    };
    const Picture wall = picture();
    const auto differs = [&](const Picture& other, int from_x, int to_x) {
        int count = 0;
        for (int y = 0; y < other.height; ++y)
            for (int x = from_x; x < to_x; ++x)
                for (int c = 0; c < 3; ++c) {
                    const std::size_t at = std::size_t(3 * (y * other.width + x) + c);
                    count += wall.rgb[at] != other.rgb[at] ? 1 : 0;
                }
        return count;
    };
    // The same densities from the same depth: what differs is that the picture says it is peeled.
    request.peel.preset = "soft-tissue";
    const Picture chosen = picture();
    EXPECT_GT(differs(chosen, 0, 200), 0);
    EXPECT_EQ(differs(chosen, 200, 400), 0);
    // In a circle: what lies around it is the wall still.
    request.peel.preset = "fat";
    request.peel.options.offset_mm = 4;
    request.peel.middle_only = true;
    request.peel.circle_at = Pixel{300, 200};
    request.peel.circle_px = 40;
    const Picture circled = picture();
    EXPECT_GT(differs(circled, 270, 330), 1000);
    EXPECT_EQ(differs(circled, 345, 400), 0);
}

}  // namespace
}  // namespace vicon::viewer
