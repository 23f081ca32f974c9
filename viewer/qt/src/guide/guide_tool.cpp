#include "guide/guide_tool.h"

#include <QApplication>
#include <array>

#include "guide/guide.h"
#include "reading/reading.h"
#include "window/reading_layout.h"

namespace vicon::viewer {
namespace {

constexpr const char *kWindow = "The window", *kMeasuring = "Measuring", *kMarking = "Markers",
                     *kColon = "Is it the colon?", *kSlices = "Hangings, and slices first", *kFlying = "Fly-through",
                     *kPanorama = "All of the wall at once", *kTogether = "Supine and prone together";

struct Page {
    const char* part;  // the name of a widget, or of one around it
    const char* heading;
};

constexpr std::array kGuidePages{Page{"markerTable", kMarking},
                                 Page{"coverage", "Coverage"},
                                 Page{"colonPanel", kColon},
                                 Page{"peeling", "Translucency"},
                                 Page{"priors", "Earlier reports"},
                                 Page{"reportFormDock", "From marks to a signed report"},
                                 Page{"cube", kPanorama},
                                 Page{"band", kPanorama},
                                 Page{"overview", kPanorama},
                                 Page{"window", kSlices},
                                 Page{"axial", kSlices},
                                 Page{"coronal", kSlices},
                                 Page{"sagittal", kSlices},
                                 Page{"across", kSlices},
                                 Page{"pairPanel", kTogether},
                                 Page{"beside", kTogether},
                                 Page{"endoscopic", kFlying},
                                 Page{"navigation", kFlying}};

const char* headingOf(const QWidget* widget)
{
    for (; widget; widget = widget->parentWidget())
        for (const Page& page : kGuidePages)
            if (widget->objectName() == page.part)
                return page.heading;
    return nullptr;
}

}  // namespace

void GuideTool::addTo(ReadingLayout& layout)
{
    layout.addAction(ReadingMenu::help, tr("Guide to this place"), QKeySequence("F1"),
                     [this] { showGuide(*reading_.views().window(), headingHere()); });
}

QStringList GuideTool::headings()
{
    QStringList all{kWindow, kMeasuring};
    for (const Page& page : kGuidePages)
        all << page.heading;
    return all;
}

/// What is being done; else what has the keyboard, but for the view that always has it; else what the mouse is on.
QString GuideTool::headingHere() const
{
    const Interaction& doing = reading_.interaction();
    if (doing.measures())
        return kMeasuring;
    if (doing.inUse<PlaceMarker>() || doing.inUse<MoveMarker>() || doing.inUse<PairMarker>())
        return kMarking;
    if (doing.inUse<Correct>())
        return kColon;
    const QWidget* first = reading_.views().first();
    const QWidget* focus = QApplication::focusWidget();
    for (const QWidget* place :
         {focus == first ? nullptr : focus, static_cast<const QWidget*>(QApplication::widgetAt(QCursor::pos())), first})
        if (const char* heading = headingOf(place))
            return heading;
    return kWindow;
}

}  // namespace vicon::viewer
