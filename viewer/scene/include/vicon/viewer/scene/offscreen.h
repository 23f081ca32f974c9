#pragma once

#include <memory>

#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/display.h"

class vtkRenderer;

namespace vicon::viewer {

/// Renders into memory. Holds a Display.
class Offscreen {
public:
    /// Throws Error{no_display}.
    explicit Offscreen(vtkRenderer* renderer);
    ~Offscreen();
    Offscreen(const Offscreen&) = delete;
    Offscreen& operator=(const Offscreen&) = delete;

    /// @param smooth each pixel is the mean of smooth x smooth ones; 1: exactly one, without any smoothing
    Picture render(int width, int height, int smooth = 1);
    /// Renders without reading back: for measuring.
    void draw(int width, int height);
    /// Duration of the last render() or draw() without reading back, in seconds.
    double seconds() const { return seconds_; }

private:
    Display display_;
    struct Window;
    std::unique_ptr<Window> window_;
    double seconds_ = 0;
};

}  // namespace vicon::viewer
