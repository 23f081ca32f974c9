#include "vicon/core/file_copy.h"

#include <fcntl.h>
#include <sys/sendfile.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "vicon/core/file_modes.h"

namespace vicon {
namespace {

constexpr std::size_t kBlock = 1U << 16U;

/// 0 when all of it is written.
int writeAll(int to, const char* bytes, ssize_t count)
{
    while (count > 0) {
        const ssize_t written = ::write(to, bytes, std::size_t(count));
        if (written < 0 && errno != EINTR)
            return errno;
        bytes += written > 0 ? written : 0;
        count -= written > 0 ? written : 0;
    }
    return 0;
}

int copyByBlocks(int from, int to)
{
    std::array<char, kBlock> block;
    for (;;) {
        const ssize_t count = ::read(from, block.data(), block.size());
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return count < 0 ? errno : 0;
        if (const int number = writeAll(to, block.data(), count); number != 0)
            return number;
    }
}

/// Without the bytes coming here, where the system can.
int copyInside(int from, int to)
{
    constexpr std::size_t kMost = 1U << 30U;
    for (;;) {
        const ssize_t count = ::sendfile(to, from, nullptr, kMost);
        if (count == 0)
            return 0;
        if (count < 0 && (errno == EINVAL || errno == ENOSYS))
            return copyByBlocks(from, to);
        if (count < 0 && errno != EINTR)
            return errno;
    }
}

}  // namespace

int copyBytes(const std::filesystem::path& from, const std::filesystem::path& to)
{
    const int source = ::open(from.c_str(), O_RDONLY | O_CLOEXEC);
    if (source < 0)
        return errno;
    const int target = openOrMake(to, O_TRUNC);
    int number = target < 0 ? errno : copyInside(source, target);
    ::close(source);
    if (target >= 0 && ::close(target) != 0 && number == 0)
        number = errno;
    return number;
}

}  // namespace vicon
