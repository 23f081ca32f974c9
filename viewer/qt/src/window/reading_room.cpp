#include "vicon/viewer/qt/reading_room.h"

#include <QApplication>
#include <QTimer>
#include <cstdlib>

#include "vicon/core/error.h"
#include "vicon/viewer/scene/display.h"
#include "widgets/focus_ring.h"
#include "widgets/theme.h"
#include "worklist/worklist_window.h"

namespace vicon::viewer {

std::unique_ptr<QWidget> makeReadingRoom(const ReadingServices& services, const std::string& case_id)
{
    applyTheme();
    auto room = std::make_unique<WorklistWindow>(services, case_id);
    new FocusRing(room.get());
    return room;
}

namespace {

/// Where the screen has no OpenGL, pictures are made on a private display; the window, which is on the screen by now,
/// stays there. Nothing where neither draws: the window says so.
std::unique_ptr<Display> displayForPictures()
{
    try {
        return std::make_unique<Display>();
    } catch (const Error& e) {
        if (e.code() != ErrorCode::no_display)
            throw;
        return nullptr;
    }
}

}  // namespace

void requireScreen()
{
    if (!Display::hasScreen())
        throw Error(ErrorCode::no_display, "there is no screen to show a window on", "DISPLAY",
                    "start it from a desktop session, or set DISPLAY to one; 'vicon snapshot' needs none");
}

int runReadingRoom(const ReadingServices& services, const std::string& case_id, const std::atomic<bool>& stop)
{
    requireScreen();
    // Pictures come from VTK's own context; Qt opens none that a broken driver could fail at.
    qputenv("QT_XCB_GL_INTEGRATION", "none");
    int argc = 1;
    char name[] = "vicon";
    char* argv[] = {name, nullptr};
    QCoreApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
    QApplication application(argc, argv);
    QCoreApplication::setOrganizationName("vicon");
    QCoreApplication::setApplicationName("vicon");
    const auto pictures = displayForPictures();
    const auto room = makeReadingRoom(services, case_id);
    QTimer asked;
    QObject::connect(&asked, &QTimer::timeout, [&] {
        if (stop)
            QApplication::closeAllWindows();
    });
    constexpr int kAsk_ms = 200;
    asked.start(kAsk_ms);
    room->show();
    return QApplication::exec();
}

}  // namespace vicon::viewer
