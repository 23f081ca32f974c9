#include "mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "vicon/core/error.h"

namespace vicon::artefact {

MappedFile::MappedFile(const std::filesystem::path& file) : size_(std::filesystem::file_size(file))
{
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    void* bytes = descriptor < 0 ? MAP_FAILED : ::mmap(nullptr, size_, PROT_READ, MAP_SHARED, descriptor, 0);
    if (descriptor >= 0)
        ::close(descriptor);
    if (bytes == MAP_FAILED)
        throw Error(ErrorCode::store, "cannot be read", file.string(), "check the permissions of the store");
    ::madvise(bytes, size_, MADV_WILLNEED);  // a hint: from a disk, the first look should not wait for every page
    data_ = static_cast<const std::byte*>(bytes);
}

MappedFile::~MappedFile()
{
    ::munmap(const_cast<std::byte*>(data_), size_);
}

}  // namespace vicon::artefact
