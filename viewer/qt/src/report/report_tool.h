#pragma once

#include "reading/reading_tool.h"

namespace vicon::viewer {

/// Writes the case's report.
class ReportTool : public ReadingTool {
    Q_OBJECT
public:
    using ReadingTool::ReadingTool;
    void addTo(ReadingLayout& layout) override;
};

}  // namespace vicon::viewer
