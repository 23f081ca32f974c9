#include "vicon/viewer/scene/offscreen.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <chrono>

#include "driver_leaks.h"
#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

// The mean of smooth x smooth pixels; VTK's rows begin at the bottom.
Picture shrunk(const std::uint8_t* rgb, int width, int height, int smooth)
{
    Picture out(width, height);
    const std::size_t row = std::size_t(width) * std::size_t(smooth) * 3;
    const int samples = smooth * smooth;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                int sum = 0;
                for (int dy = 0; dy < smooth; ++dy)
                    for (int dx = 0; dx < smooth; ++dx)
                        sum += rgb[std::size_t((height - 1 - y) * smooth + dy) * row +
                                   std::size_t((x * smooth + dx) * 3 + c)];
                out.rgb[(std::size_t(y) * std::size_t(width) + std::size_t(x)) * 3 + std::size_t(c)] =
                    std::uint8_t((sum + samples / 2) / samples);
            }
    return out;
}

}  // namespace

struct Offscreen::Window {
    vtkNew<vtkRenderWindow> vtk;
};

Offscreen::Offscreen(vtkRenderer* renderer) : window_(std::make_unique<Window>())
{
    const DriverLeaks not_ours;
    window_->vtk->SetOffScreenRendering(1);
    window_->vtk->SetMultiSamples(0);
    // Otherwise VTK copies colours and depths of each frame to the buffers that a screen would show.
    window_->vtk->SetSwapBuffers(0);
    if (!display_.draws() || !window_->vtk->SupportsOpenGL())
        throw Error(ErrorCode::no_display, "the display has no OpenGL 3.2", display_.name(),
                    "install the Debian package 'libgl1-mesa-dri', or unset DISPLAY to use a private display");
    window_->vtk->AddRenderer(renderer);
}

Offscreen::~Offscreen() = default;

void Offscreen::draw(int width, int height)
{
    window_->vtk->SetSize(width, height);
    const DriverLeaks not_ours;
    const auto begin = std::chrono::steady_clock::now();
    window_->vtk->Render();
    window_->vtk->WaitForCompletion();
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

Picture Offscreen::render(int width, int height, int smooth)
{
    const int w = width * smooth, h = height * smooth;
    draw(w, h);
    vtkNew<vtkUnsignedCharArray> pixels;
    window_->vtk->GetPixelData(0, 0, w - 1, h - 1, 0, pixels);
    if (pixels->GetNumberOfValues() != vtkIdType(w) * h * 3)
        throw Error(ErrorCode::no_display, "the picture cannot be read back from the display", display_.name());
    return shrunk(pixels->GetPointer(0), width, height, smooth);
}

}  // namespace vicon::viewer
