#include "deflated_size.h"

#include <zlib.h>

#include <algorithm>
#include <vector>

namespace vicon::ingest {
namespace {

constexpr std::size_t kInputBytes = 4096, kOutputBytes = 1 << 16;

}  // namespace

std::uint64_t deflatedSize(ElementSource& source, std::uint64_t place, std::uint64_t most)
{
    z_stream stream{};
    if (::inflateInit2(&stream, -MAX_WBITS) != Z_OK)
        return most + 1;
    std::vector<unsigned char> out(kOutputBytes);
    std::uint64_t size = 0;
    int status = Z_OK;
    while (status == Z_OK && size <= most) {
        if (stream.avail_in == 0) {
            const std::size_t count = std::min<std::uint64_t>(kInputBytes, source.size() - place);
            const unsigned char* in = count > 0 ? source.at(place, count) : nullptr;
            if (!in)
                break;
            stream.next_in = const_cast<unsigned char*>(in);
            stream.avail_in = unsigned(count);
            place += count;
        }
        stream.next_out = out.data();
        stream.avail_out = unsigned(out.size());
        status = ::inflate(&stream, Z_NO_FLUSH);
        size += out.size() - stream.avail_out;
    }
    ::inflateEnd(&stream);
    return size;
}

}  // namespace vicon::ingest
