#include "progress_line.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "command.h"

namespace vicon::app {
namespace {

constexpr int kBarWidth = 30;
constexpr std::chrono::milliseconds kBarInterval{100};
constexpr std::chrono::seconds kLineInterval{5};

}  // namespace

ProgressLine::ProgressLine(std::string title) : title_(std::move(title)), terminal_(::isatty(STDERR_FILENO) != 0)
{
    if (!terminal_)  // what is done at once needs no line
        last_ = std::chrono::steady_clock::now();
}

ProgressLine::~ProgressLine()
{
    clear();
}

void ProgressLine::clear()
{
    const std::lock_guard lock(mutex_);
    if (drawn_)
        std::fputs("\r\033[K", stderr);
    drawn_ = false;
}

void ProgressLine::rename(const std::string& title)
{
    const std::lock_guard lock(mutex_);
    title_ = title;
}

void ProgressLine::report(double fraction, std::string_view what)
{
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < (terminal_ ? std::chrono::nanoseconds(kBarInterval) : std::chrono::nanoseconds(kLineInterval)))
        return;
    last_ = now;
    const double shown = std::clamp(fraction, 0.0, 1.0);
    const std::string text(what);
    if (!terminal_) {
        std::fprintf(stderr, "%s: %3.0f %% %s\n", title_.c_str(), shown * 100, text.c_str());
        return;
    }
    const int filled = int(shown * kBarWidth);
    std::fprintf(stderr, "\r\033[K%s [%s%s] %3.0f %% %s", title_.c_str(), std::string(std::size_t(filled), '#').c_str(),
                 std::string(std::size_t(kBarWidth - filled), '.').c_str(), shown * 100, text.c_str());
    std::fflush(stderr);
    drawn_ = true;
}

bool ProgressLine::cancelled() const
{
    return stopRequested();
}

}  // namespace vicon::app
