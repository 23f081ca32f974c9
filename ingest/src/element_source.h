#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace vicon::ingest {

/// Bytes of a file, read in blocks wherever they are asked for. Not for several threads at once.
class ElementSource {
public:
    /// A file that cannot be opened is one of no bytes; error() tells.
    explicit ElementSource(const std::filesystem::path& file);
    ~ElementSource();
    ElementSource(const ElementSource&) = delete;
    ElementSource& operator=(const ElementSource&) = delete;

    std::uint64_t size() const { return size_; }
    /// The number of the system's error; 0 for none.
    int error() const { return error_; }
    /// `count` bytes, at most 16384, from a place; null when they are not all there.
    const unsigned char* at(std::uint64_t place, std::size_t count);

private:
    int descriptor_ = -1;
    int error_ = 0;
    std::uint64_t size_ = 0, block_from_ = 0;
    std::vector<unsigned char> block_;
};

}  // namespace vicon::ingest
