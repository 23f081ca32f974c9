// When nothing more comes of what was begun: what tests wait for where something must not happen.
#include <QWindow>
#include <atomic>
#include <functional>
#include <thread>

#include "reading.h"
#include "slices/slice_view.h"
#include "widgets/rest_timer.h"
#include "widgets/worker.h"

namespace vicon::viewer {
namespace {

class Quiet : public test::Reading {
protected:
    void SetUp() override
    {
        Reading::SetUp();
        waitUntilQuiet();
    }

    QObject owner_;
    Worker worker_{&owner_};
};

TEST_F(Quiet, IsNotWhileWorkRuns)
{
    std::atomic<bool> go = false;
    bool shown = false;
    worker_.post("work", [&]() -> Worker::Work {
        while (!go)
            std::this_thread::yield();
        return [&shown] { shown = true; };
    });
    EXPECT_FALSE(quiet());
    go = true;
    waitUntilQuiet();
    EXPECT_TRUE(shown);
}

TEST_F(Quiet, IsNotBeforeTheResultOfWorkIsShown)
{
    bool shown = false;
    worker_.post("work", [&]() -> Worker::Work { return [&shown] { shown = true; }; });
    worker_.post("later", []() -> Worker::Work { return {}; });
    // No event is handled meanwhile: what the first work returned still waits when the second one is done.
    EXPECT_TRUE(support::waitUntil([] { return UnderWay::count() == 1; }));
    EXPECT_FALSE(shown);
    waitUntilQuiet();
    EXPECT_TRUE(shown);
}

TEST_F(Quiet, IsNotBetweenWorkAndTheWorkThatFollowsFromIt)
{
    constexpr int kSteps = 50;
    Worker other(&owner_);
    int steps = 0;
    std::function<void()> next = [&] {
        if (++steps < kSteps)
            (steps % 2 == 0 ? worker_ : other).post("step", [&next]() -> Worker::Work { return next; });
    };
    next();
    waitUntilQuiet();
    EXPECT_EQ(steps, kSteps);
}

TEST_F(Quiet, IsWhenWhatWaitedIsGivenUp)
{
    std::atomic<bool> go = false;
    bool shown = false;
    worker_.post("work", [&]() -> Worker::Work {
        while (!go)
            std::this_thread::yield();
        return {};
    });
    for (int n = 0; n < 3; ++n)  // later work of a name replaces what waits
        worker_.post("waits", [&]() -> Worker::Work { return [&shown] { shown = true; }; });
    worker_.giveUp("waits");
    go = true;
    waitUntilQuiet();
    EXPECT_FALSE(shown);
}

TEST_F(Quiet, IsWhenAWorkerThatWasEndedIsAskedForMoreWhileItStillWorks)
{
    std::atomic<bool> go = false, later = false, saved = false;
    worker_.post("work", [&]() -> Worker::Work {
        while (!go)
            std::this_thread::yield();
        return {};
    });
    EXPECT_TRUE(support::waitUntil([] { return UnderWay::count() == 1; }));
    worker_.end();
    worker_.post("later", [&]() -> Worker::Work {
        later = true;
        return {};
    });
    worker_.postAlways([&]() -> Worker::Work {
        saved = true;
        return {};
    });
    go = true;
    EXPECT_TRUE(support::waitUntil([&] { return worker_.ended(); }));
    EXPECT_FALSE(later);
    EXPECT_TRUE(saved) << "what must be saved is, also then";
}

TEST_F(Quiet, IsNotWhileADrawingWaitsUntilTheHandRests)
{
    int drawn = 0;
    RestTimer timer(1, [&] { ++drawn; });
    timer.start();
    EXPECT_FALSE(quiet());
    timer.start();
    waitUntilQuiet();
    EXPECT_EQ(drawn, 1);
    timer.start();
    timer.stop();
    waitUntilQuiet();
    EXPECT_EQ(drawn, 1) << "stopped";
}

TEST_F(Quiet, IsNotBeforeTheWindowSystemHasAnswered)
{
    for (int n = 0; n < 20; ++n) {
        QWidget widget;
        widget.show();
        waitUntilQuiet();
        EXPECT_TRUE(widget.windowHandle()->isExposed());
    }
}

TEST_F(Quiet, IsNotInFlightAndThenEveryViewShowsTheLastPlace)
{
    openCase();
    press(window(), "forward");
    for (const double far : {10, 20, 30}) {
        ASSERT_TRUE(eventually([&] { return station() > far; }));
        EXPECT_FALSE(quiet()) << far;
    }
    press(window(), "stop");
    waitUntilQuiet();
    EXPECT_TRUE(pictureIsThere());
    for (const char* view : {"axial", "coronal", "sagittal"}) {
        const auto* slice = the<SliceView>(view);
        EXPECT_LT(std::abs(slice->shown().depth_mm(slice->point_mm())), 1e-6) << view;
    }
    const QImage last = pictureOf("endoscopic");
    key(Qt::Key_V);
    key(Qt::Key_V);
    waitUntilQuiet();
    EXPECT_EQ(pictureOf("endoscopic"), last) << "it was the smooth one";
}

}  // namespace
}  // namespace vicon::viewer
