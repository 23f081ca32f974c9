#pragma once

#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

namespace vicon::ingest {

/// The bytes of a file from a place on, as they are or unpacked (zlib, gzip), a piece at a time: a stream that unpacks
/// into more than anybody asks for costs nothing.
class VoxelStream {
public:
    /// Throws Error{not_found}.
    VoxelStream(const std::filesystem::path& file, std::uint64_t begin, bool packed);
    ~VoxelStream();
    VoxelStream(const VoxelStream&) = delete;
    VoxelStream& operator=(const VoxelStream&) = delete;

    /// Throws Error{bad_input} where fewer are left, or what is packed is damaged.
    void read(void* to, std::size_t count);
    void skip(std::uint64_t count);
    /// Throws Error{bad_input} where more is left, or the check sum is another.
    void requireEnd();

private:
    std::size_t readSome(char* to, std::size_t count);
    std::size_t unpackSome(char* to, std::size_t count);

    std::filesystem::path file_;
    std::ifstream in_;
    bool packed_;
    bool ended_ = false;
    z_stream stream_{};
    std::vector<unsigned char> packed_bytes_;
};

}  // namespace vicon::ingest
