#pragma once

namespace vicon::viewer {

/// Dark colours for a dim room, for all windows of the application that runs.
void applyTheme();

}  // namespace vicon::viewer
