#pragma once

class QMainWindow;

namespace vicon::viewer {

/// A list of all keys of the window: those of its menus, and those of its views.
void showKeys(QMainWindow& window);

}  // namespace vicon::viewer
