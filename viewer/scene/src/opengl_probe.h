#pragma once

struct _XDisplay;  // NOLINT(bugprone-reserved-identifier): X11's own name

namespace vicon::viewer {

/// Whether OpenGL 3.2, which VTK needs, can be used on a display: a context is made and thrown away. VTK ends the
/// whole program where it cannot make one, as with a driver that does not load.
bool drawsWithOpenGl(_XDisplay* display);

}  // namespace vicon::viewer
