#include "report/report_tool.h"

#include "reading/reading.h"
#include "window/reading_layout.h"

namespace vicon::viewer {

void ReportTool::addTo(ReadingLayout& layout)
{
    layout.addAction(ReadingMenu::a_case, tr("Write report"), QKeySequence("Ctrl+P"), [this] {
        reading_.say(tr("Writing the report ..."));
        reading_.session().writeReport();
    });
    connect(&reading_.session(), &CaseSession::reportWritten, this,
            [this](const QString& file) { reading_.say(tr("Report written: %1").arg(file)); });
}

}  // namespace vicon::viewer
