#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>

namespace vicon::ingest {

/// A file of copies of other files, one behind the other. Its blocks are allocated before and stay so while copies are
/// given up and others take their place, so that the disk is flushed once for one or several of them, and no table of
/// the file system changes. A copy is whole, or is not found again; what a copied file holds cannot be made to look
/// like one.
class JournalPart {
public:
    explicit JournalPart(std::filesystem::path file) : file_(std::move(file)) {}
    ~JournalPart();
    JournalPart(const JournalPart&) = delete;
    JournalPart& operator=(const JournalPart&) = delete;

    static bool mayHold(std::uint64_t bytes);
    bool hasRoomFor(std::uint64_t bytes) const;
    /// The place of a copy; not for several threads. Throws Error{store}.
    std::uint64_t reserve(std::uint64_t bytes);
    /// Copies a file to its place and flushes it; for several threads. Throws Error{store}.
    /// @param name of one line, by which it is found again
    void copy(const std::filesystem::path& from, std::uint64_t bytes, std::uint64_t place, const std::string& name);
    /// Gives up all copies, durably, while none is made. Throws Error{store}.
    void renew();
    /// The same; nothing of them is left in the file.
    void clear();

private:
    void open();
    bool hasPlentyOfRoom() const;
    void writeZeros(std::uint64_t bytes);
    void writeHead();
    void flush();

    std::filesystem::path file_;
    int descriptor_ = -1;
    std::string key_;
    std::uint64_t end_ = 0;
    // Whoever comes while the disk is being flushed waits, and the next flush is for all of them.
    std::mutex mutex_;
    std::condition_variable changed_;
    std::uint64_t asked_ = 0, flushed_ = 0;
    bool flushing_ = false, broken_ = false;
};

/// Puts the whole copies of a part back, durably: each under `folder` by its name. Throws Error{store}.
void restoreCopies(const std::filesystem::path& part, const std::filesystem::path& folder);

}  // namespace vicon::ingest
