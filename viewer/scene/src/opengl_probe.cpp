#include "opengl_probe.h"

#include <GL/glx.h>
#include <GL/glxext.h>
#include <X11/Xlib.h>

#include <cstring>
#include <mutex>

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

}  // namespace

bool drawsWithOpenGl(::Display* display)
{
    const DriverLeaks not_ours;
    const RefusalsIgnored meanwhile;
    if (!glXQueryExtension(display, nullptr, nullptr))
        return false;
    const int wanted[] = {
        GLX_DRAWABLE_TYPE, GLX_WINDOW_BIT | GLX_PBUFFER_BIT, GLX_RENDER_TYPE, GLX_RGBA_BIT, GLX_DEPTH_SIZE, 1, None};
    int count = 0;
    GLXFBConfig* configs = glXChooseFBConfig(display, DefaultScreen(display), wanted, &count);
    if (!configs)
        return false;
    const GLXContext context = count > 0 ? contextOf(display, configs[0]) : nullptr;
    XFree(static_cast<void*>(configs));
    XSync(display, False);
    if (!context)
        return false;
    glXDestroyContext(display, context);
    return true;
}

}  // namespace vicon::viewer
