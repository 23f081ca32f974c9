#include "mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>

#include "vicon/core/error.h"

namespace vicon::scan_files {

MappedFile::MappedFile(const std::filesystem::path& file) : size_(std::filesystem::file_size(file))
{
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    void* bytes = descriptor < 0 ? MAP_FAILED : ::mmap(nullptr, size_, PROT_READ, MAP_SHARED, descriptor, 0);
    if (descriptor >= 0)
        ::close(descriptor);
    if (bytes == MAP_FAILED)
        throw Error(ErrorCode::store, "cannot be read", file.string(), "check the permissions of the store");
    data_ = static_cast<const std::byte*>(bytes);
}

void MappedFile::readAhead(std::size_t begin, std::size_t end) const
{
    const std::size_t page = std::size_t(::sysconf(_SC_PAGESIZE)), first = begin / page * page;
    if (first < std::min(end, size_))
        ::madvise(const_cast<std::byte*>(data_) + first, std::min(end, size_) - first, MADV_WILLNEED);
}

MappedFile::~MappedFile()
{
    ::munmap(const_cast<std::byte*>(data_), size_);
}

}  // namespace vicon::scan_files
