#include "mask/voxel_stream.h"

#include <algorithm>
#include <array>

#include "mask/refusal.h"

namespace vicon::ingest {
namespace {

constexpr std::size_t kPackedBytes = 1 << 16;
constexpr int kZlibOrGzip = MAX_WBITS + 32;
constexpr const char* kWriteAgain = "write the mask again, or copy it again";

}  // namespace

VoxelStream::VoxelStream(const std::filesystem::path& file, std::uint64_t begin, bool packed)
    : file_(file), in_(file, std::ios::binary), packed_(packed)
{
    if (!in_)
        throw Error(ErrorCode::not_found, "cannot be opened", file.string(), "check the name");
    in_.seekg(std::streamoff(begin));
    if (packed_ && ::inflateInit2(&stream_, kZlibOrGzip) != Z_OK)
        throw Error(ErrorCode::no_memory, "there is no memory to unpack it", file.string(), "close other programs");
    packed_bytes_.resize(packed_ ? kPackedBytes : 0);
}

VoxelStream::~VoxelStream()
{
    if (packed_)
        ::inflateEnd(&stream_);
}

void VoxelStream::read(void* to, std::size_t count)
{
    for (char* at = static_cast<char*>(to); count > 0;) {
        const std::size_t some = packed_ ? unpackSome(at, count) : readSome(at, count);
        if (some == 0)
            throw maskRefused(file_, "is cut off: it holds fewer voxels than its header says", kWriteAgain);
        at += some;
        count -= some;
    }
}

void VoxelStream::skip(std::uint64_t count)
{
    std::array<char, 4096> passed{};
    for (; count > 0; count -= std::min<std::uint64_t>(count, passed.size()))
        read(passed.data(), std::min<std::uint64_t>(count, passed.size()));
}

void VoxelStream::requireEnd()
{
    char more = 0;
    if ((packed_ ? unpackSome(&more, 1) : readSome(&more, 1)) > 0)
        throw maskRefused(file_, "holds more bytes than its header says", kWriteAgain);
}

std::size_t VoxelStream::readSome(char* to, std::size_t count)
{
    in_.read(to, std::streamsize(count));
    return std::size_t(in_.gcount());
}

/// Nothing where the stream has ended, or the file within it.
std::size_t VoxelStream::unpackSome(char* to, std::size_t count)
{
    const auto wanted = uInt(std::min<std::size_t>(count, 1 << 20));
    stream_.next_out = reinterpret_cast<unsigned char*>(to);
    stream_.avail_out = wanted;
    while (!ended_ && stream_.avail_out == wanted) {
        if (stream_.avail_in == 0) {
            stream_.avail_in = uInt(readSome(reinterpret_cast<char*>(packed_bytes_.data()), packed_bytes_.size()));
            stream_.next_in = packed_bytes_.data();
            if (stream_.avail_in == 0)
                throw maskRefused(file_, "is cut off", kWriteAgain);
        }
        const int status = ::inflate(&stream_, Z_NO_FLUSH);
        if (status != Z_OK && status != Z_STREAM_END)
            throw maskRefused(file_, "is damaged: it cannot be unpacked", kWriteAgain);
        ended_ = status == Z_STREAM_END;
    }
    return wanted - stream_.avail_out;
}

}  // namespace vicon::ingest
