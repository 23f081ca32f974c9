#include "zlib_stream.h"

#include <libdeflate.h>

#include <memory>
#include <new>

namespace vicon::scan_files {
namespace {

constexpr int kFastest = 1;  // of its 12 levels: labels pack to two thirds of what zlib makes of them at its level 1

template <class Made, class Free>
std::unique_ptr<Made, Free> owned(Made* made, Free free)
{
    if (!made)
        throw std::bad_alloc();
    return {made, free};
}

}  // namespace

std::vector<std::byte> pack(std::span<const std::byte> bytes)
{
    const auto compressor = owned(libdeflate_alloc_compressor(kFastest), &libdeflate_free_compressor);
    const std::size_t most = libdeflate_zlib_compress_bound(compressor.get(), bytes.size());
    // Not a vector: it would write over memory of which a hundredth is used.
    const std::unique_ptr<std::byte[]> room(new std::byte[most]);
    const std::size_t count = libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), room.get(), most);
    return {room.get(), room.get() + count};
}

bool unpack(std::span<const std::byte> packed, std::span<std::byte> to)
{
    const auto decompressor = owned(libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
    return libdeflate_zlib_decompress(decompressor.get(), packed.data(), packed.size(), to.data(), to.size(),
                                      nullptr) == LIBDEFLATE_SUCCESS;
}

}  // namespace vicon::scan_files
