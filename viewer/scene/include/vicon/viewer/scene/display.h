#pragma once

#include <memory>
#include <string>

namespace vicon::viewer {

/// Makes sure that there is an X server with OpenGL while the object lives. Uses the one that $DISPLAY names when it
/// answers; else starts a private Xvfb (no TCP, a cookie of its own) and points $DISPLAY and $XAUTHORITY of this
/// process to it. The private server ends with the object, and with the process however that ends. Any number of
/// processes may do so at once; within a process further objects share the first one's server.
/// Construct it before other threads read the environment.
class Display {
public:
    /// Throws Error{no_display} where neither is to be had.
    Display();
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    /// The display's name, ":0" or the private one's.
    std::string name() const;
    /// Whether a private server was started.
    bool isPrivate() const;
    /// Whether this process can draw there now, with the OpenGL driver that it has.
    bool draws() const;
    /// Whether an X server answers at $DISPLAY, with or without OpenGL: a screen for a window.
    static bool hasScreen();

private:
    struct Server;
    std::shared_ptr<Server> server_;
};

}  // namespace vicon::viewer
