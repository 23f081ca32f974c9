#include "opengl_probe.h"

#include "vicon/core/error.h"
#include "vicon/viewer/scene/display.h"
#include "vicon/viewer/scene/opengl_renderer.h"
// X11 defines common words as macros.
#include <GL/glx.h>
#include <GL/glxext.h>
#include <X11/Xlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <mutex>
#include <string>

#include "driver_leaks.h"

namespace vicon::viewer {
namespace {

/// While one lives, what the X server refuses does not end the program. Xlib knows one handler a process.
class RefusalsIgnored {
public:
    RefusalsIgnored() : lock_(only_), before_(XSetErrorHandler([](::Display*, XErrorEvent*) { return 0; })) {}
    ~RefusalsIgnored() { XSetErrorHandler(before_); }
    RefusalsIgnored(const RefusalsIgnored&) = delete;
    RefusalsIgnored& operator=(const RefusalsIgnored&) = delete;

private:
    static inline std::mutex only_;
    std::lock_guard<std::mutex> lock_;
    XErrorHandler before_;
};

bool hasExtension(::Display* display, const char* name)
{
    const char* all = glXQueryExtensionsString(display, DefaultScreen(display));
    return all && std::strstr(all, name);
}

/// As VTK asks for it.
GLXContext contextOf(::Display* display, GLXFBConfig config)
{
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): how GLX gives its functions
    const auto create = reinterpret_cast<PFNGLXCREATECONTEXTATTRIBSARBPROC>(
        glXGetProcAddressARB(reinterpret_cast<const GLubyte*>("glXCreateContextAttribsARB")));
    if (!create || !hasExtension(display, "GLX_ARB_create_context"))
        return nullptr;
    const int attributes[] = {GLX_CONTEXT_MAJOR_VERSION_ARB, 3, GLX_CONTEXT_MINOR_VERSION_ARB, 2, None};
    return create(display, config, nullptr, True, attributes);
}

struct Freed {
    void operator()(GLXFBConfig* configs) const { XFree(static_cast<void*>(configs)); }
};
using Configs = std::unique_ptr<GLXFBConfig, Freed>;

/// Those that a window and a picture out of sight can have; null: none.
Configs configsOf(::Display* display)
{
    if (!glXQueryExtension(display, nullptr, nullptr))
        return nullptr;
    const int wanted[] = {
        GLX_DRAWABLE_TYPE, GLX_WINDOW_BIT | GLX_PBUFFER_BIT, GLX_RENDER_TYPE, GLX_RGBA_BIT, GLX_DEPTH_SIZE, 1, None};
    int count = 0;
    Configs configs(glXChooseFBConfig(display, DefaultScreen(display), wanted, &count));
    return count > 0 ? std::move(configs) : nullptr;
}

/// Empty where nothing draws.
std::string rendererOn(::Display* display)
{
    const DriverLeaks not_ours;
    const RefusalsIgnored meanwhile;
    const Configs configs = configsOf(display);
    const GLXContext context = configs ? contextOf(display, *configs) : nullptr;
    if (!context)
        return {};
    const int size[] = {GLX_PBUFFER_WIDTH, 1, GLX_PBUFFER_HEIGHT, 1, None};
    const GLXPbuffer picture = glXCreatePbuffer(display, *configs, size);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): how GLX gives OpenGL's functions
    const auto get_string = reinterpret_cast<const GLubyte* (*)(GLenum)>(
        glXGetProcAddressARB(reinterpret_cast<const GLubyte*>("glGetString")));
    std::string name;
    if (get_string && glXMakeContextCurrent(display, picture, picture, context)) {
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): OpenGL's bytes are characters
        const char* said = reinterpret_cast<const char*>(get_string(GL_RENDERER));
        name = said ? said : "";
        glXMakeContextCurrent(display, None, None, nullptr);
    }
    glXDestroyPbuffer(display, picture);
    glXDestroyContext(display, context);
    return name;
}

}  // namespace

bool drawsWithOpenGl(::Display* display)
{
    const DriverLeaks not_ours;
    const RefusalsIgnored meanwhile;
    const Configs configs = configsOf(display);
    const GLXContext context = configs ? contextOf(display, *configs) : nullptr;
    XSync(display, False);
    if (!context)
        return false;
    glXDestroyContext(display, context);
    return true;
}

std::string openGlRenderer(const Display& display)
{
    ::Display* connection = XOpenDisplay(display.name().c_str());
    std::string renderer = connection ? rendererOn(connection) : "";
    if (connection)
        XCloseDisplay(connection);
    if (renderer.empty())
        throw Error(ErrorCode::no_display, "nothing draws on this display with OpenGL 3.2", display.name());
    return renderer;
}

bool drawsInSoftware(const std::string& renderer)
{
    constexpr std::array kOnTheProcessor{"llvmpipe", "softpipe", "swrast", "Software", "SWR"};
    return std::any_of(kOnTheProcessor.begin(), kOnTheProcessor.end(),
                       [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

}  // namespace vicon::viewer
