#include "element_source.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace vicon::ingest {
namespace {

constexpr std::size_t kSourceBlockBytes = 16384;

}  // namespace

ElementSource::ElementSource(const std::filesystem::path& file)
    : descriptor_(::open(file.c_str(), O_RDONLY | O_CLOEXEC))
{
    struct stat about {};
    if (descriptor_ < 0 || ::fstat(descriptor_, &about) != 0)
        error_ = errno;
    else
        size_ = std::uint64_t(about.st_size);
}

ElementSource::~ElementSource()
{
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

const unsigned char* ElementSource::at(std::uint64_t place, std::size_t count)
{
    if (place > size_ || size_ - place < count)
        return nullptr;
    if (place < block_from_ || place + count > block_from_ + block_.size()) {
        block_.resize(kSourceBlockBytes);
        const ssize_t some = ::pread(descriptor_, block_.data(), block_.size(), off_t(place));
        if (some < 0)
            error_ = errno;
        block_.resize(std::size_t(std::max<ssize_t>(some, 0)));
        block_from_ = place;
        if (block_.size() < count)
            return nullptr;
    }
    return block_.data() + (place - block_from_);
}

}  // namespace vicon::ingest
