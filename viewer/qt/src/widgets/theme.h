#pragma once

#include <QColor>

namespace vicon::viewer {

/// Dark colours for a dim room, for all windows of the application that runs.
void applyTheme();

/// Of the frame around what has the keyboard: seen at once on the theme's greys, on its blue, on wall and on slices.
QColor focusColor();

}  // namespace vicon::viewer
