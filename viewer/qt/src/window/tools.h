#pragma once

#include <memory>
#include <vector>

#include "reading/reading_tool.h"
#include "vicon/viewer/qt/reading_room.h"

namespace vicon::viewer {

class OpeningTool;

struct ReadingTools {
    std::vector<std::unique_ptr<ReadingTool>> all;  ///< in the order in which they are told what happens
    OpeningTool* opening = nullptr;                 ///< one of them
};

/// Every tool of the reading window.
/// @param case_row the case that is read
ReadingTools makeReadingTools(Reading& reading, const ReadingServices& services, const WorklistCase& case_row);

}  // namespace vicon::viewer
