#pragma once

#include <filesystem>

namespace vicon::scan_files {

/// A file's bytes as memory, to be read only; they stay when the file is replaced or deleted.
class MappedFile {
public:
    /// Throws Error{store}.
    explicit MappedFile(const std::filesystem::path& file);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    const std::byte* data() const { return data_; }
    /// Asks the disk for the bytes [begin, end) now, a hint: who looks at them soon should not wait for every page.
    void readAhead(std::size_t begin, std::size_t end) const;

private:
    const std::byte* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace vicon::scan_files
