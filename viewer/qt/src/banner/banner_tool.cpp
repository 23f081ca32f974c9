#include "banner/banner_tool.h"

#include "reading/reading.h"
#include "window/reading_layout.h"

namespace vicon::viewer {

void BannerTool::scanOpened(const Arrival&)
{
    const QString words = reading_.scan()->inWords();
    layout_->showBanner(words);
    reading_.views().window()->setWindowTitle(tr("%1 - VICON").arg(words));
}

}  // namespace vicon::viewer
