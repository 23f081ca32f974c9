#include "unpack.h"

#include <libdeflate.h>

#include <memory>
#include <new>

namespace vicon::scan_files {

bool unpack(std::span<const std::byte> packed, std::span<std::byte> to)
{
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
        libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
    if (!decompressor)
        throw std::bad_alloc();
    return libdeflate_zlib_decompress(decompressor.get(), packed.data(), packed.size(), to.data(), to.size(),
                                      nullptr) == LIBDEFLATE_SUCCESS;
}

}  // namespace vicon::scan_files
