#pragma once

class QApplication;

namespace vicon::viewer {

/// Dark colours for a dim room.
void applyTheme(QApplication& application);

}  // namespace vicon::viewer
