#include "vicon/viewer/scene/display.h"

#include <X11/Xlib.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "opengl_probe.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/temporary_folder.h"

namespace fs = std::filesystem;

namespace vicon::viewer {
namespace {

constexpr int kStart_ms = 30000;  // a loaded machine starts Xvfb in seconds, never in minutes
constexpr const char* kRemedy = "install the Debian package 'xvfb', or set DISPLAY to an X server with OpenGL";

bool answersWithOpenGl(const char* name)
{
    ::Display* display = XOpenDisplay(name);
    if (!display)
        return false;
    const bool has_gl = drawsWithOpenGl(display);
    XCloseDisplay(display);
    return has_gl;
}

std::string findProgram(const std::string& name)
{
    const char* path = std::getenv("PATH");
    std::string folders = path ? path : "";
    folders += ":/usr/bin:/usr/local/bin";
    for (std::size_t at = 0; at <= folders.size();) {
        const std::size_t end = std::min(folders.find(':', at), folders.size());
        std::string file = folders.substr(at, end - at) + "/" + name;
        if (::access(file.c_str(), X_OK) == 0)
            return file;
        at = end + 1;
    }
    throw Error(ErrorCode::no_display, "no display answers, and there is no " + name, name, kRemedy);
}

// An X authority file with one cookie for any display of any host: wild family (0xffff), no address, no number.
std::string cookieFile()
{
    std::array<unsigned char, 16> cookie;
    if (::getrandom(cookie.data(), cookie.size(), 0) != ssize_t(cookie.size()))
        throw Error(ErrorCode::no_display, "the system gives no random numbers");
    static constexpr std::string_view kProtocol = "MIT-MAGIC-COOKIE-1";
    const auto length = [](std::size_t n) { return std::string{char(n >> 8), char(n & 255)}; };
    return "\xff\xff" + length(0) + length(0) + length(kProtocol.size()) + std::string(kProtocol) +
           length(cookie.size()) + std::string(cookie.begin(), cookie.end());
}

void setVariable(const char* name, const std::optional<std::string>& value)
{
    if (value)
        ::setenv(name, value->c_str(), 1);
    else
        ::unsetenv(name);
}

std::optional<std::string> variable(const char* name)
{
    const char* value = std::getenv(name);
    return value ? std::optional<std::string>(value) : std::nullopt;
}

/// Mesa's software OpenGL starts a thread a core, and they fill each picture together, from a common start to a common
/// end. When the system puts two of them on one core, the other core idles for the whole picture. Two a core are shared
/// out more evenly; docs/evaluation/flight-and-window.md has the times. A variable that is set already is left as it
/// is. Other drivers ignore it.
void startMoreRasterizers()
{
    ::setenv("LP_NUM_THREADS", std::to_string(2 * std::max(std::thread::hardware_concurrency(), 1U)).c_str(), 0);
}

}  // namespace

struct Display::Server {
    std::string name;
    bool is_private = false;

    Server()
    {
        startMoreRasterizers();
        const auto wanted = variable("DISPLAY");
        if (wanted && !wanted->empty() && answersWithOpenGl(wanted->c_str())) {
            name = *wanted;
            return;
        }
        start();
    }
    ~Server()
    {
        if (!is_private)
            return;
        stop();
        setVariable("DISPLAY", old_display_);
        setVariable("XAUTHORITY", old_authority_);
    }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

private:
    void start();
    void stop();
    void launch(const std::string& program, int write_end);
    std::string awaitName(int read_end);

    fs::path folder_;
    std::optional<std::string> old_display_, old_authority_;
    std::thread keeper_;  // the parent of Xvfb: the kernel kills a child with PDEATHSIG when its parent *thread* ends
    std::mutex mutex_;
    std::condition_variable changed_;
    pid_t pid_ = 0;  // 0: not launched yet, -1: cannot be
    bool done_ = false;
};

void Display::Server::launch(const std::string& program, int write_end)
{
    const std::string auth = (folder_ / "authority").string(), log = (folder_ / "log").string();
    const std::string fd = std::to_string(write_end);
    std::vector<const char*> arguments{program.c_str(), "-displayfd", fd.c_str(), "-screen",  "0",
                                       "1280x1024x24",  "-nolisten",  "tcp",      "-noreset", "-auth",
                                       auth.c_str(),    nullptr};
    const pid_t parent = ::getpid();
    const pid_t pid = ::fork();
    if (pid == 0) {  // only calls that are safe between fork and exec
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent)
            ::_exit(127);
        const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        ::dup2(out, 1);
        ::dup2(out, 2);
        ::fcntl(write_end, F_SETFD, 0);
        ::setpgid(0, 0);  // an interrupt typed at the terminal is for VICON, which then ends the server itself
        sigset_t none;
        ::sigemptyset(&none);
        ::sigprocmask(SIG_SETMASK, &none, nullptr);
        ::execv(program.c_str(), const_cast<char* const*>(arguments.data()));
        ::_exit(127);
    }
    const std::lock_guard lock(mutex_);
    pid_ = pid > 0 ? pid : -1;
    changed_.notify_all();
}

std::string Display::Server::awaitName(int read_end)
{
    std::string digits;
    while (!digits.ends_with('\n')) {
        pollfd waiting{read_end, POLLIN, 0};
        const int ready = ::poll(&waiting, 1, kStart_ms);
        if (ready < 0 && errno == EINTR)
            continue;
        char c = 0;
        if (ready <= 0 || ::read(read_end, &c, 1) != 1)
            return {};
        digits += c;
    }
    digits.pop_back();
    return ":" + digits;
}

void Display::Server::start()
{
    const std::string program = findProgram("Xvfb");
    folder_ = makeTemporaryFolder("vicon-display-", ErrorCode::no_display);
    replaceFile(folder_ / "authority", cookieFile());
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
        throw Error(ErrorCode::no_display, "no pipe can be made to a private X server");
    keeper_ = std::thread([this, program, write_end = ends[1]] {
        launch(program, write_end);
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return done_; });
    });
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return pid_ != 0; });
    }
    ::close(ends[1]);
    name = pid_ > 0 ? awaitName(ends[0]) : "";
    ::close(ends[0]);
    old_display_ = variable("DISPLAY");
    old_authority_ = variable("XAUTHORITY");
    setVariable("DISPLAY", name);
    setVariable("XAUTHORITY", (folder_ / "authority").string());
    is_private = true;
    if (name.empty() || !answersWithOpenGl(name.c_str())) {
        setVariable("DISPLAY", old_display_);
        setVariable("XAUTHORITY", old_authority_);
        stop();
        throw Error(ErrorCode::no_display, "the private X server does not start or has no OpenGL", program, kRemedy);
    }
}

void Display::Server::stop()
{
    if (pid_ > 0) {
        ::kill(pid_, SIGTERM);  // it removes its lock and socket
        constexpr int kPatience = 100;
        int tries = 0;
        while (::waitpid(pid_, nullptr, WNOHANG) == 0) {
            if (++tries == kPatience)
                ::kill(pid_, SIGKILL);
            ::usleep(20000);
        }
    }
    {
        const std::lock_guard lock(mutex_);
        done_ = true;
        changed_.notify_all();
    }
    if (keeper_.joinable())
        keeper_.join();
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

Display::Display()
{
    static std::mutex mutex;
    static std::weak_ptr<Server> shared;
    const std::lock_guard lock(mutex);
    server_ = shared.lock();
    if (!server_) {
        server_ = std::make_shared<Server>();
        shared = server_;
    }
}

Display::~Display() = default;

std::string Display::name() const
{
    return server_->name;
}

bool Display::draws() const
{
    return answersWithOpenGl(server_->name.c_str());
}

bool Display::hasScreen()
{
    ::Display* display = XOpenDisplay(nullptr);
    if (display)
        XCloseDisplay(display);
    return display != nullptr;
}

bool Display::isPrivate() const
{
    return server_->is_private;
}

}  // namespace vicon::viewer
