#include "standard_streams.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace vicon::app {
namespace {

bool readerHasLeft()
{
    pollfd output{STDOUT_FILENO, POLLOUT, 0};
    return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

}  // namespace

void openStandardStreams()
{
    for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(number, F_GETFD) < 0)  // the lowest that is free: open() takes it
            (void)!::open("/dev/null", number == STDOUT_FILENO ? O_RDONLY : O_RDWR);
}

std::string whyNotPrinted()
{
    errno = 0;
    const bool flushed = std::fflush(stdout) == 0;
    const int number = errno;
    if ((flushed && !std::ferror(stdout)) || readerHasLeft())
        return {};
    const std::string why = flushed ? "" : " (" + std::string(std::strerror(number)) + ")";
    return "standard output: cannot be written" + why + "; what was to be done is done, what it printed is lost";
}

}  // namespace vicon::app
