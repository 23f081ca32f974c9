#include "banner/banner_tool.h"

#include "reading/reading.h"
#include "session/case_session.h"
#include "widgets/case_flags.h"
#include "window/reading_layout.h"

namespace vicon::viewer {

BannerTool::BannerTool(Reading& reading) : ReadingTool(reading)
{
    connect(&reading.session(), &CaseSession::flagsChanged, this, &BannerTool::show);
}

void BannerTool::scanOpened(const Arrival&)
{
    show();
    reading_.views().window()->setWindowTitle(tr("%1 - VICON").arg(reading_.scan()->inWords()));
}

void BannerTool::show()
{
    if (!reading_.scan())
        return;
    const CaseRecord& record = reading_.session().record();
    const QString words = reading_.scan()->inWords(), flags = flagsOf(record);
    layout_->showBanner(flags.isEmpty() ? words : tr("%1  ! %2 to decide").arg(words).arg(record.flags.size()), flags);
    if (!flags.isEmpty())
        layout_->warn(flags);
}

}  // namespace vicon::viewer
