// What runs on other threads: it can be given up, and nobody takes what it has not shown yet for what it will show.
#include <QComboBox>
#include <QLabel>
#include <QSignalSpy>
#include <QStatusBar>
#include <atomic>
#include <functional>

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

TEST_F(AWorker, DoesNotDoWhatWasFoundBeforeItWasGivenUp)
{
    int found = 0;
    const auto find = [&](const char* name) {
        worker_.post(name, [&]() -> Worker::Work { return [&found] { ++found; }; });
    };
    find("a");
    find("b");
    std::atomic<bool> both = false;
    worker_.post("after them", [&]() -> Worker::Work {
        both = true;
        return {};
    });
    ASSERT_TRUE(support::waitUntil([&] { return both.load(); }));  // no event is handled meanwhile
    EXPECT_TRUE(worker_.giveUp("a"));
    EXPECT_FALSE(worker_.giveUp("a")) << "it is given up already";
    EXPECT_FALSE(worker_.giveUp("of another name"));
    waitUntilQuiet();
    EXPECT_EQ(found, 1);
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

/// What a reader begins in the open scan, each kind on another thread.
class Begun : public Reading {
protected:
    struct Kind {
        const char* name;
        std::function<void()> begin;
    };

    void SetUp() override
    {
        Reading::SetUp();
        openCase();
    }
    static void circle()
    {
        const QPoint at = middle("endoscopic") + QPoint(-150, 20);
        key(Qt::Key_T);
        drag("endoscopic", at, at + QPoint(110, 0));
    }
    /// Over the wall from one end of the colon to the other: no way is as short as is looked for, which takes longest.
    static void measureFar()
    {
        key(Qt::Key_Home);
        waitUntilQuiet();
        key(Qt::Key_M);
        click("endoscopic", middle("endoscopic") + QPoint(-150, 20));
        key(Qt::Key_End);
        ASSERT_TRUE(eventually([] { return length() - station() < 5 && pictureIsThere(); }));
        click("endoscopic", middle("endoscopic") + QPoint(150, 20));
    }
    static std::vector<Kind> kinds()
    {
        return {
            {"biopsy", circle},
            {"size over the wall", measureFar},
            {"outline",
             [] {
                 key(Qt::Key_M, Qt::ShiftModifier);
                 click("endoscopic", middle("endoscopic") + QPoint(-150, 20));
             }},
            {"slab",
             [] {
                 key(Qt::Key_Y);
                 key(Qt::Key_Y, Qt::ShiftModifier);
             }},
            {"cube", [] { key(Qt::Key_U); }},
            {"band", [] { key(Qt::Key_B, Qt::ShiftModifier); }},
            {"projection turned", [] { drag("overview", middle("overview"), middle("overview") + QPoint(40, 10)); }},
            {"missed regions", [] { showList(1); }},
            {"proposed pairs", [] { showList(kPairs); }}};
    }
    static constexpr int kPairs = 4;
    /// Nothing of what was begun in the scan before is shown, but that a size was given up.
    static void expectNothingOfIt(const char* name)
    {
        EXPECT_TRUE(warning().empty() ||
                    warning() == "Another scan was opened before the size was there: measure it again.")
            << name << ": " << warning();
        EXPECT_FALSE(the<QLabel>("histogram")->isVisible()) << name;
        const QString said = window()->statusBar()->currentMessage();
        EXPECT_FALSE(said.contains("HU") || said.contains("marker beside it")) << name << ": " << said.toStdString();
    }
};

TEST_F(Begun, InAScanNeitherHoldsUpTheNextNorIsShownThere)
{
    auto* scan = the<QComboBox>("scan");
    for (const Kind& kind : kinds()) {
        const QString before = scan->currentText();
        ASSERT_NO_FATAL_FAILURE(kind.begin()) << kind.name;
        key(Qt::Key_X);
        ASSERT_TRUE(eventually([&] { return pictureIsThere() && scan->currentText() != before; })) << kind.name;
        waitUntilQuiet();
        expectNothingOfIt(kind.name);
    }
}

TEST_F(Begun, IsGivenUpByEscape)
{
    for (const auto& begin : {circle, measureFar}) {
        ASSERT_NO_FATAL_FAILURE(begin());
        key(Qt::Key_Escape);
        waitUntilQuiet();
        expectNothingOfIt("escape");
    }
    EXPECT_TRUE(stored().empty());
}

TEST_F(Begun, DoesNotKeepTheWindow)
{
    for (const Kind& kind : {kinds().front(), kinds()[1], kinds().back()}) {
        ASSERT_NO_FATAL_FAILURE(kind.begin()) << kind.name;
        ASSERT_NO_FATAL_FAILURE(closeCase()) << kind.name;
        ASSERT_NO_FATAL_FAILURE(startOpening()) << kind.name;  // and neither does a scan that is being opened
        ASSERT_NO_FATAL_FAILURE(closeCase()) << kind.name;
        ASSERT_NO_FATAL_FAILURE(openCase()) << kind.name;
    }
}

TEST_F(Reading, ThePictureSaysWhileItIsNotAsTheListOfTranslucencySays)
{
    openCase();
    auto* view = the<PictureView>("endoscopic");
    std::vector<QImage> of_before{view->image()};
    // What is shown without a word while this is changed by keys and until the picture follows.
    const auto shownFrom = [&](const char* control, const std::vector<int>& keys) {
        auto* changed = the<QWidget>(control);
        changed->setFocus();
        for (const int key : keys) {
            QTest::keyClick(changed, Qt::Key(key));
            EXPECT_FALSE(view->note().isEmpty()) << control << ": at once";
        }
        std::vector<QImage> shown;
        EXPECT_TRUE(eventually([&] {
            if (view->note().isEmpty() && (shown.empty() || shown.back() != view->image()))
                shown.push_back(view->image());
            return quiet();
        }));
        EXPECT_EQ(view->note(), "");
        EXPECT_FALSE(shown.empty());
        return shown;
    };
    const auto expectNoneOf = [](const std::vector<QImage>& old, const std::vector<QImage>& shown, const char* what) {
        for (const QImage& image : shown)
            EXPECT_EQ(std::count(old.begin(), old.end(), image), 0) << what;
    };
    const auto takeNew = [&](const std::vector<QImage>& shown) {
        of_before.insert(of_before.end(), shown.begin(), shown.end());
    };
    ASSERT_EQ(view->note(), "");
    const QImage plain = of_before.front();
    auto shown = shownFrom("peel", {Qt::Key_Down});
    expectNoneOf(of_before, shown, "off to the first");
    takeNew(shown);
    shown = shownFrom("peel", {Qt::Key_Down, Qt::Key_Down});  // the second is under way when the third is chosen
    expectNoneOf(of_before, shown, "first to third");
    takeNew(shown);
    shown = shownFrom("peelOffset", {Qt::Key_PageDown});
    expectNoneOf(of_before, shown, "begins before the wall");
    takeNew(shown);
    shown = shownFrom("peelOver", {Qt::Key_Space});
    expectNoneOf(of_before, shown, "over the surface");
    takeNew(shown);
    of_before.erase(of_before.begin());
    shown = shownFrom("peel", {Qt::Key_Home});  // off again
    expectNoneOf(of_before, shown, "third to off");
    EXPECT_EQ(shown.back(), plain);
}

/// How many pixels of a square around a place differ.
int differingAround(QPoint at, const QImage& one, const QImage& other)
{
    constexpr int kHalf = 20;
    int differing = 0;
    for (int y = at.y() - kHalf; y <= at.y() + kHalf; ++y)
        for (int x = at.x() - kHalf; x <= at.x() + kHalf; ++x)
            differing += one.pixel(x, y) != other.pixel(x, y) ? 1 : 0;
    return differing;
}

TEST_F(Reading, TranslucencyInACircleFollowsTheMouseAndLeavesTheWallAround)
{
    openCase();
    auto* view = the<PictureView>("endoscopic");
    waitUntilQuiet();
    const QImage wall = view->image();
    const QPoint left(view->width() / 5, view->height() / 2), right(view->width() * 4 / 5, view->height() / 2);
    the<QWidget>("peel")->setFocus();
    QTest::keyClick(the<QWidget>("peel"), Qt::Key_Down);
    auto* box = the<QWidget>("peelCircle");
    QTest::mouseClick(box, Qt::LeftButton, {}, QPoint(8, box->height() / 2));
    for (const auto& [in, out] : {std::pair(left, right), std::pair(right, left)}) {
        QTest::mouseMove(view, in);
        EXPECT_TRUE(eventually([&, in = in, out = out] {
            return quiet() && differingAround(in, view->image(), wall) > 100 &&
                   differingAround(out, view->image(), wall) == 0;
        })) << in.x()
            << ": " << differingAround(in, view->image(), wall) << " in the circle, "
            << differingAround(out, view->image(), wall) << " around it";
        screenshot(in == left ? "circle_left" : "circle_right");
    }
    QTest::mouseClick(box, Qt::LeftButton, {}, QPoint(8, box->height() / 2));
    EXPECT_TRUE(eventually([&] { return quiet() && differingAround(left, view->image(), wall) > 100; })) << "all of it";
}

TEST_F(Reading, APictureThatIsNotOfThisPlaceYetSaysSo)
{
    openCase();
    window()->resize(1900, 1050);  // all of them have room
    const auto note = [](const char* view) { return the<PictureView>(view)->note().toStdString(); };
    key(Qt::Key_U);
    key(Qt::Key_B, Qt::ShiftModifier);
    key(Qt::Key_C);
    const std::vector<const char*> views{"endoscopic", "axial",    "coronal",          "sagittal",    "cube",
                                         "band",       "overview", "besideEndoscopic", "besideAxial", "besideOverview"};
    const auto nothingIsSaid = [&](const char* view) { return note(view).empty(); };
    for (const char* view : views)
        ASSERT_TRUE(eventually([&] {
            const auto* of = the<PictureView>(view);
            return of->isVisible() && !of->image().isNull();
        })) << view;
    waitUntilQuiet();
    for (const int to : {Qt::Key_End, Qt::Key_Home}) {
        for (const char* view : views)
            ASSERT_EQ(note(view), "") << view;
        key(to);
        for (const char* view : views)
            EXPECT_EQ(note(view), PictureView::notThisPlaceYet().toStdString()) << view;
        EXPECT_TRUE(eventually([&] { return pictureIsThere() && std::ranges::all_of(views, nothingIsSaid); }));
        waitUntilQuiet();
        drag("overview", middle("overview"), middle("overview") + QPoint(40, 10));  // and turned
        waitUntilQuiet();
    }
    key(Qt::Key_Z);
    EXPECT_EQ(note("overview"), "being drawn ...") << "from the front again";
    EXPECT_TRUE(eventually([&] { return note("overview").empty(); }));
}

}  // namespace
}  // namespace vicon::viewer
