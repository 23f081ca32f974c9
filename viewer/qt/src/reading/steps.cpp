// Tools have histories of their own; what was done last of all goes first.
#include <algorithm>

#include "reading/reading.h"

namespace vicon::viewer {

void Reading::undo()
{
    ReadingTool *last = nullptr, *under_way = nullptr;
    for (ReadingTool* tool : tools_) {
        if (tool->stepUnderWay())
            under_way = tool;
        if (undoneBefore(tool->toUndo(), last ? last->toUndo() : std::nullopt))
            last = tool;
    }
    if (under_way && last && last != under_way)
        return;  // which of the two is the last one is not known yet
    if (ReadingTool* chosen = under_way ? under_way : last)
        chosen->undo();
}

void Reading::redo()
{
    ReadingTool* first = nullptr;
    for (ReadingTool* tool : tools_)
        if (redoneBefore(tool->toRedo(), first ? first->toRedo() : std::nullopt) || (!first && tool->stepUnderWay()))
            first = tool;
    if (first)
        first->redo();
}

bool Reading::canUndo() const
{
    return std::any_of(tools_.begin(), tools_.end(),
                       [](const ReadingTool* tool) { return tool->toUndo().has_value(); });
}

bool Reading::canRedo() const
{
    return std::any_of(tools_.begin(), tools_.end(),
                       [](const ReadingTool* tool) { return tool->toRedo().has_value(); });
}

}  // namespace vicon::viewer
