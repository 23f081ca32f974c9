#include "vicon/viewer/qt/reading_room.h"

#include <QApplication>
#include <QTimer>
#include <cstdlib>

#include "theme.h"
#include "vicon/core/error.h"
#include "vicon/viewer/scene/display.h"
#include "worklist_window.h"

namespace vicon::viewer {

std::unique_ptr<QWidget> makeReadingRoom(const ReadingServices& services, const std::string& case_id)
{
    applyTheme(*qobject_cast<QApplication*>(QCoreApplication::instance()));
    return std::make_unique<WorklistWindow>(services, case_id);
}

int runReadingRoom(const ReadingServices& services, const std::string& case_id, const std::atomic<bool>& stop)
{
    const Display display;  // before any thread reads the environment
    if (display.isPrivate())
        throw Error(ErrorCode::no_display, "there is no screen to show a window on", "DISPLAY",
                    "start it from a desktop session, or set DISPLAY to one; 'vicon snapshot' needs none");
    // Pictures come from VTK's own context; Qt opens none that a broken driver could fail at.
    qputenv("QT_XCB_GL_INTEGRATION", "none");
    int argc = 1;
    char name[] = "vicon";
    char* argv[] = {name, nullptr};
    QCoreApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
    QApplication application(argc, argv);
    QCoreApplication::setOrganizationName("vicon");
    QCoreApplication::setApplicationName("vicon");
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
