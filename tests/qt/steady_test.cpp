// What runs on other threads: it can be given up, and nobody takes what it has not shown yet for what it will show.
#include <QSignalSpy>
#include <atomic>

#include "reading.h"
#include "vicon/core/error.h"
#include "widgets/picture_view.h"
#include "widgets/worker.h"

namespace vicon::viewer {
namespace {

using test::Reading;

/// Work that only ends when it is told that nobody wants it.
class Endless {
public:
    Worker::Task task()
    {
        return [this](const Progress& wanted) -> Worker::Work {
            begun = true;
            while (!wanted.cancelled())
                std::this_thread::yield();
            wanted.check();
            return {};
        };
    }

    std::atomic<bool> begun = false;
};

class AWorker : public Reading {
protected:
    QObject owner_;
    Worker worker_{&owner_};
    QSignalSpy failed_{&worker_, &Worker::failed};
    Endless endless_;
};

TEST_F(AWorker, EndsWithoutWaitingForWhatRunsAndSaysNothingOfIt)
{
    worker_.postTask("endless", endless_.task());
    ASSERT_TRUE(eventually([&] { return endless_.begun.load(); }));
    worker_.end();
    EXPECT_TRUE(eventually([&] { return worker_.ended(); }));
    EXPECT_EQ(failed_.count(), 0);
}

TEST_F(AWorker, GoesOnToTheNextWorkWhenWhatRunsIsGivenUp)
{
    worker_.postTask("endless", endless_.task());
    ASSERT_TRUE(eventually([&] { return endless_.begun.load(); }));
    bool waited = false, next = false;
    worker_.post("waits", [&]() -> Worker::Work { return [&waited] { waited = true; }; });
    worker_.post("next", [&]() -> Worker::Work { return [&next] { next = true; }; });
    worker_.giveUp("waits");
    worker_.giveUp("endless");
    EXPECT_TRUE(eventually([&] { return next; }));
    EXPECT_FALSE(waited);
    EXPECT_EQ(failed_.count(), 0);
}

TEST_F(AWorker, DoesWhatMustBeSavedToItsEnd)
{
    std::atomic<bool> begun = false, ending = false, wanted_still = false, saved = false;
    worker_.postTask({}, [&](const Progress& wanted) -> Worker::Work {
        begun = true;
        while (!ending)
            std::this_thread::yield();
        wanted_still = !wanted.cancelled();
        return {};
    });
    worker_.postAlways([&saved]() -> Worker::Work {
        saved = true;
        return {};
    });
    ASSERT_TRUE(eventually([&] { return begun.load(); }));
    worker_.end();
    ending = true;
    EXPECT_TRUE(eventually([&] { return worker_.ended(); }));
    EXPECT_TRUE(wanted_still && saved);
}

TEST_F(AWorker, TellsWhatFailedThoughItWasCalledCancelled)
{
    worker_.post("of another", []() -> Worker::Work { throw Error(ErrorCode::cancelled, "by somebody else"); });
    EXPECT_TRUE(eventually([&] { return failed_.count() == 1; }));
}

TEST_F(Reading, APictureThatIsNotOfThisPlaceYetSaysSo)
{
    openCase();
    const auto note = [](const char* view) { return the<PictureView>(view)->note().toStdString(); };
    key(Qt::Key_U);
    ASSERT_TRUE(eventually([] { return the<QWidget>("cube")->isVisible() && drawn("cube"); }));
    waitUntilQuiet();
    const std::vector<const char*> views{"endoscopic", "axial", "cube"};
    for (const char* view : views)
        ASSERT_EQ(note(view), "") << view;
    key(Qt::Key_End);
    for (const char* view : views)
        EXPECT_EQ(note(view), PictureView::notThisPlaceYet().toStdString()) << view;
    EXPECT_TRUE(eventually([&] {
        return pictureIsThere() && std::ranges::all_of(views, [&](const char* view) { return note(view).empty(); });
    }));
}

}  // namespace
}  // namespace vicon::viewer
