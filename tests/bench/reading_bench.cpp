// How long the reading room takes to open a prepared case, and how long it blocks its window's thread.
//   vicon_reading_bench STORE CASE
// Opens the case from the worklist, flies, jumps, scrolls, paints what was seen, lists what was not, and closes. Every
// event of the window's thread is timed: a call that takes longer is felt as a jerk. Its CPU time stands beside the
// time passed, which on a busy machine says less of the event than of the machine. Notes are made in a copy of the
// reader's settings; the store gets the list of what was seen, nothing else.
#include <sys/resource.h>

#include <QApplication>
#include <QLabel>
#include <QMainWindow>
#include <QMouseEvent>
#include <QPushButton>
#include <QTabWidget>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QtTest/QTest>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <map>
#include <vector>

#include "vicon/core/error.h"
#include "vicon/viewer/qt/reading_room.h"
#include "vicon/viewer/scene/display.h"
#include "widgets/picture_view.h"

using namespace vicon;
using namespace vicon::viewer;

namespace {

using Clock = std::chrono::steady_clock;
constexpr double kFelt_ms = 50;
constexpr int kPatience_ms = 60000;

double millisecondsSince(Clock::time_point begin)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// CPU time of the calling thread.
double cpuMilliseconds()
{
    timespec t{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

/// How often the calling thread waited for something, a lock or the disk, of its own accord, and how often it touched a
/// page of a mapped file that had to be read.
struct Waits {
    long all = 0, pages_read = 0;

    static Waits soFar()
    {
        rusage usage{};
        ::getrusage(RUSAGE_THREAD, &usage);
        return {usage.ru_nvcsw, usage.ru_majflt};
    }
    Waits since(const Waits& begin) const { return {all - begin.all, pages_read - begin.pages_read}; }
};

/// What the longest event of a kind took.
struct Event {
    double ms = 0, cpu_ms = 0;
    Waits waits;
};

/// Times every event that reaches the window's thread.
class TimedApplication : public QApplication {
public:
    using QApplication::QApplication;

    bool notify(QObject* to, QEvent* event) override
    {
        if (++depth_ > 1) {  // within an event that is timed already
            const bool done = QApplication::notify(to, event);
            --depth_;
            return done;
        }
        const std::string what = std::string(to->metaObject()->className()) + " " + to->objectName().toStdString() +
                                 ", event " + std::to_string(int(event->type()));
        const auto begin = Clock::now();
        const double cpu_begin = cpuMilliseconds();
        const Waits waits_begin = Waits::soFar();
        const bool done = QApplication::notify(to, event);
        const Event took{millisecondsSince(begin), cpuMilliseconds() - cpu_begin, Waits::soFar().since(waits_begin)};
        depth_ = 0;
        durations_.push_back(took.ms);
        most_cpu_ms_ = std::max(most_cpu_ms_, took.cpu_ms);
        if (Event& longest = longest_[what]; took.ms > longest.ms)
            longest = took;
        return done;
    }

    /// Forgets what was measured so far.
    void begin()
    {
        durations_.clear();
        longest_.clear();
        most_cpu_ms_ = 0;
    }

    void print(const char* stage)
    {
        std::sort(durations_.begin(), durations_.end());
        const auto at = [&](double part) {
            return durations_.empty() ? 0 : durations_[std::size_t(part * double(durations_.size() - 1))];
        };
        const auto felt = durations_.end() - std::upper_bound(durations_.begin(), durations_.end(), kFelt_ms);
        std::printf("| %s | %zu | %.1f | %.1f | %.1f | %td |\n", stage, durations_.size(), at(0.99), at(1),
                    most_cpu_ms_, felt);
        std::fflush(stdout);
        printLongest(stage);
        begin();
    }

private:
    void printLongest(const char* stage) const
    {
        constexpr std::size_t kListed = 5;
        std::vector<std::pair<std::string, Event>> kinds(longest_.begin(), longest_.end());
        std::sort(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a.second.ms > b.second.ms; });
        kinds.resize(std::min(kinds.size(), kListed));
        for (const auto& [what, took] : kinds)
            std::fprintf(stderr, "  %s: %.1f ms, CPU %.1f ms, %ld waits, %ld pages read: %s\n", stage, took.ms,
                         took.cpu_ms, took.waits.all, took.waits.pages_read, what.c_str());
    }

    int depth_ = 0;
    std::vector<double> durations_;
    double most_cpu_ms_ = 0;
    std::map<std::string, Event> longest_;
};

ReadingServices servicesFor(const std::filesystem::path& folder)
{
    ReadingServices services;
    services.store = folder;
    services.worklist = [](CaseStore& store, const WorklistPageWanted&) {
        WorklistPage page;
        for (const CaseRecord& record : store.cases()) {
            WorklistCase row{record, WorkState::done, "", 1, 0, 0, {}};
            for (const ScanRecord& scan : store.scans(record.id))
                if (scan.role == ScanRole::scan)
                    row.scans.push_back({scan, WorkState::done, "", 1, "", store.scanFolder(record.id, scan.id), {}});
            page.cases.push_back(row);
        }
        return page;
    };
    services.bridges = [](CaseStore&, const ScanRecord&) { return std::vector<ReviewedBridge>(); };
    return services;
}

QMainWindow* window()
{
    for (QWidget* widget : QApplication::topLevelWidgets())
        if (widget->objectName() == "reading")
            return qobject_cast<QMainWindow*>(widget);
    return nullptr;
}

template <class T>
T* the(const char* name)
{
    T* found = window() ? window()->findChild<T*>(name) : nullptr;
    if (!found)
        throw Error(ErrorCode::internal, "the window has no such part", name);
    return found;
}

template <class Condition>
void await(const char* what, Condition condition)
{
    if (!QTest::qWaitFor(condition, kPatience_ms))
        throw Error(ErrorCode::internal, "did not happen", what);
}

bool shows(const char* view)
{
    return window() && !the<PictureView>(view)->image().isNull();
}

void press(const char* button)
{
    QTest::mouseClick(the<QPushButton>(button), Qt::LeftButton);
}

void open(TimedApplication& application, QWidget& room)
{
    application.begin();
    const auto begin = Clock::now();
    QTest::mouseClick(room.findChild<QPushButton*>("open"), Qt::LeftButton);
    await("a first picture", [] { return shows("endoscopic"); });
    const double first_s = millisecondsSince(begin) / 1000;
    window()->activateWindow();  // without a window manager nobody else does, and keys would do nothing
    await("all pictures", [] { return shows("overview") && shows("axial") && shows("coronal") && shows("sagittal"); });
    const qint64 shown = the<PictureView>("endoscopic")->image().cacheKey();
    press("stepOn");
    await("an answer", [&] { return the<PictureView>("endoscopic")->image().cacheKey() != shown; });
    std::printf("first picture after %.2f s, all usable after %.2f s\n\n", first_s, millisecondsSince(begin) / 1000);
    std::printf("| stage | events | 99 %% ms | longest ms | most CPU ms | over %.0f ms |\n|---|---|---|---|---|---|\n",
                kFelt_ms);
    application.print("opening");
}

void use(TimedApplication& application)
{
    constexpr int kFlight_ms = 8000, kRest_ms = 1500;
    press("forward");
    QTest::qWait(kFlight_ms);
    press("stop");
    QTest::qWait(kRest_ms);
    application.print("flight, 8 s");
    for (const int part : {3, 5, 7, 2}) {
        auto* overview = the<QWidget>("overview");
        QTest::mouseClick(overview, Qt::LeftButton, {}, {overview->width() * part / 10, overview->height() / 2});
        QTest::qWait(kRest_ms);
    }
    QTest::mouseClick(the<QWidget>("coronal"), Qt::LeftButton, {}, the<QWidget>("coronal")->rect().center());
    QTest::qWait(kRest_ms);
    application.print("jumps and clicks");
    QTest::keyClick(window(), Qt::Key_V);
    QTest::keyClick(window(), Qt::Key_R);
    QTest::qWait(kRest_ms);
    auto* lists = the<QTabWidget>("lists");
    QTest::mouseClick(lists->tabBar(), Qt::LeftButton, {}, lists->tabBar()->tabRect(1).center());
    await("unseen patches", [] { return the<QTableWidget>("unseen")->rowCount() > 0; });
    application.print("what was seen");
    std::printf("\n%s\n", the<QLabel>("seen")->text().toUtf8().constData());
}

void drag(const char* view, QPoint by)
{
    auto* over = the<QWidget>(view);
    const QPoint from = over->rect().center();
    QTest::mousePress(over, Qt::LeftButton, {}, from);
    constexpr int kSteps = 30, kBetween_ms = 30;
    for (int n = 1; n <= kSteps; ++n) {
        QMouseEvent move(QEvent::MouseMove, from + by * n / kSteps, Qt::LeftButton, Qt::LeftButton, {});
        QApplication::sendEvent(over, &move);
        QTest::qWait(kBetween_ms);
    }
    QTest::mouseRelease(over, Qt::LeftButton, {}, from + by);
}

/// The unfolded cube, the band and the projection that turns.
void useAllOfTheWall(TimedApplication& application)
{
    constexpr int kFlight_ms = 4000, kRest_ms = 1500;
    const auto fly = [] {
        press("forward");
        QTest::qWait(kFlight_ms);
        press("stop");
        QTest::qWait(kRest_ms);
    };
    QTest::keyClick(window(), Qt::Key_U);
    await("a cube", [] { return shows("cube"); });
    fly();
    QTest::mouseClick(the<QWidget>("cube"), Qt::LeftButton, {}, the<QWidget>("cube")->rect().center());
    QTest::qWait(kRest_ms);
    QTest::keyClick(window(), Qt::Key_U);
    application.print("cube, flight of 4 s");
    const auto begin = Clock::now();
    QTest::keyClick(window(), Qt::Key_B, Qt::ShiftModifier);
    await("a band", [] { return shows("band"); });
    std::fprintf(stderr, "  first band after %.2f s\n", millisecondsSince(begin) / 1000);
    fly();
    QTest::mouseClick(the<QWidget>("band"), Qt::LeftButton, {}, the<QWidget>("band")->rect().center());
    QTest::qWait(kRest_ms);
    QTest::keyClick(window(), Qt::Key_B, Qt::ShiftModifier);
    application.print("band, flight of 4 s");
    drag("overview", {90, 40});
    QTest::qWait(kRest_ms);
    QTest::keyClick(window(), Qt::Key_Z);
    application.print("projection turned");
}

void close(TimedApplication& application)
{
    application.begin();
    window()->close();
    await("the end", [] { return window() == nullptr; });
    application.print("closing");
}

int run(int argc, char** argv)
{
    if (argc != 3)
        throw Error(ErrorCode::wrong_use, "wants a store and a case");
    const Display display;
    const QTemporaryDir settings;
    qputenv("XDG_CONFIG_HOME", settings.path().toUtf8());
    qputenv("QT_XCB_GL_INTEGRATION", "none");
    TimedApplication application(argc, argv);
    QCoreApplication::setOrganizationName("vicon");
    const auto room = makeReadingRoom(servicesFor(argv[1]));
    room->show();
    auto* cases = room->findChild<QTableWidget*>("cases");
    await("a worklist", [&] { return cases->rowCount() > 0; });
    CaseStore store(argv[1]);
    const std::string patient = store.requireCase(argv[2]).patient.id;
    for (int row = 0; row < cases->rowCount(); ++row)
        if (cases->item(row, 1)->text().toStdString() == patient)
            cases->selectRow(row);
    open(application, *room);
    use(application);
    useAllOfTheWall(application);
    close(application);
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        return run(argc, argv);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
