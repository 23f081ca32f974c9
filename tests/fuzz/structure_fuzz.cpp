// Whatever a file holds, the walk over its elements ends, within its memory.
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "structure_scan.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const int descriptor = ::memfd_create("fuzz", MFD_CLOEXEC);
    if (::ftruncate(descriptor, 0) != 0 || ::pwrite(descriptor, data, size, 0) != ssize_t(size))
        return 0;
    const auto found = vicon::ingest::scanStructure("/proc/self/fd/" + std::to_string(descriptor));
    if (found.fate == vicon::ingest::Structure::Fate::refused && found.why.empty())
        std::abort();  // a refusal has a reason
    if (found.trailing_bytes > size)
        std::abort();
    return 0;
}
