#include "streamed_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>

#include "vicon/core/error.h"

namespace vicon::scan_files {
namespace {

/// What direct writing asks of addresses, lengths and places in the file: the largest sector in use.
constexpr std::size_t kAlignment = 4096;
constexpr std::size_t kBlock = 4U << 20;  // large enough that the disk, not the call, sets the pace

}  // namespace

void StreamedFile::Free::operator()(void* block) const
{
    std::free(block);
}

StreamedFile::StreamedFile(const std::filesystem::path& file, std::filesystem::path shown_as)
    : shown_as_(std::move(shown_as)), block_(static_cast<char*>(std::aligned_alloc(kAlignment, kBlock)))
{
    if (!block_)
        throw std::bad_alloc();
    constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC;
    fd_ = ::open(file.c_str(), kFlags | O_DIRECT, S_IRUSR | S_IWUSR);
    if (fd_ < 0 && errno == EINVAL)
        fd_ = ::open(file.c_str(), kFlags, S_IRUSR | S_IWUSR);
    if (fd_ < 0)
        failed();
}

StreamedFile::~StreamedFile()
{
    if (fd_ >= 0)
        ::close(fd_);
}

void StreamedFile::failed() const
{
    throw Error(ErrorCode::store, "cannot be written (" + std::string(std::strerror(errno)) + ")", shown_as_.string(),
                "check the disk's free space");
}

void StreamedFile::writeBlocks(std::size_t count)
{
    for (std::size_t done = 0; done < count;) {
        const ssize_t n = ::write(fd_, block_.get() + done, count - done);
        if (n >= 0) {
            done += std::size_t(n);
            continue;
        }
        const int flags = ::fcntl(fd_, F_GETFL);
        // Some file systems take the flag and refuse the writing.
        const bool direct = errno == EINVAL && flags >= 0 && (flags & O_DIRECT) != 0;
        if (errno != EINTR && !(direct && ::fcntl(fd_, F_SETFL, flags & ~O_DIRECT) == 0))
            failed();
    }
    filled_ = 0;
}

void StreamedFile::write(const void* bytes, std::size_t count)
{
    for (const auto* from = static_cast<const char*>(bytes); count > 0;) {
        const std::size_t part = std::min(count, kBlock - filled_);
        std::memcpy(block_.get() + filled_, from, part);
        filled_ += part;
        written_ += part;
        from += part;
        count -= part;
        if (filled_ == kBlock)
            writeBlocks(kBlock);
    }
}

void StreamedFile::finish()
{
    const std::size_t padded = (filled_ + kAlignment - 1) / kAlignment * kAlignment;
    std::memset(block_.get() + filled_, 0, padded - filled_);
    writeBlocks(padded);
    if (::ftruncate(fd_, off_t(written_)) != 0)
        failed();
}

}  // namespace vicon::scan_files
