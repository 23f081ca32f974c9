#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

namespace vicon::scan_files {

/// A large file written once, front to end, past the system's page cache where the file system allows that (O_DIRECT,
/// see open(2)): copying hundreds of megabytes to fresh pages costs more time than computing them, and pushes out what
/// others read. Where it is not allowed the file is written as usual.
class StreamedFile {
public:
    /// Makes the file, or empties it. Throws Error{store}, as all methods do; `shown_as` is the name in its text.
    StreamedFile(const std::filesystem::path& file, std::filesystem::path shown_as);
    ~StreamedFile();
    StreamedFile(const StreamedFile&) = delete;
    StreamedFile& operator=(const StreamedFile&) = delete;

    void write(const void* bytes, std::size_t count);
    /// Writes what is left and gives the file its length. Without it the file is not whole.
    void finish();

private:
    void writeBlocks(std::size_t count);
    [[noreturn]] void failed() const;

    struct Free {
        void operator()(void* block) const;
    };
    std::filesystem::path shown_as_;
    std::unique_ptr<char, Free> block_;
    std::size_t filled_ = 0;  ///< bytes of the block
    std::size_t written_ = 0;
    int fd_ = -1;
};

}  // namespace vicon::scan_files
