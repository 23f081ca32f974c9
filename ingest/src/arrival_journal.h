#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "journal_part.h"

namespace vicon::ingest {

/// Makes received files durable, each at the price of one flush of the disk: a copy is flushed in one of two parts of a
/// journal. While copies come into one part, a thread flushes the files of the other, many at once, and gives their
/// copies up. After a crash the next journal of the folder puts back what may not have reached the disk.
class ArrivalJournal {
public:
    using OnTrouble = std::function<void(const std::string&)>;
    /// Puts back what a crash left, durably; while nobody else works for the folder. Throws Error{store}.
    ArrivalJournal(std::filesystem::path folder, OnTrouble on_trouble);
    /// Flushes the rest, and removes the journal.
    ~ArrivalJournal();
    ArrivalJournal(const ArrivalJournal&) = delete;
    ArrivalJournal& operator=(const ArrivalJournal&) = delete;

    /// Renames a file to a name in a folder below the journal's: durably, and only when it is durable itself. Where the
    /// journal cannot take it, the file is flushed. For several threads. Throws Error{store}.
    void keep(const std::filesystem::path& temporary, const std::filesystem::path& target);
    /// Waits until all files kept so far lie durably without the journal, where nothing of them is left: who takes one
    /// away after that does not find it put back. Throws Error{store} when they cannot be flushed.
    void settle();

private:
    /// A part in its turn: the files whose copies it holds.
    struct Turn {
        explicit Turn(std::filesystem::path file) : part(std::move(file)) {}
        JournalPart part;
        std::vector<std::filesystem::path> kept;
        int writers = 0;
        bool settled = true;
    };
    Turn& current() { return turns_[turn_ % 2]; }
    const Turn& current() const { return turns_[turn_ % 2]; }
    Turn& other() { return turns_[(turn_ + 1) % 2]; }
    const Turn& other() const { return turns_[(turn_ + 1) % 2]; }
    Turn* turnFor(std::uint64_t bytes, std::uint64_t& place);
    bool isCopied(const std::filesystem::path& temporary, const std::filesystem::path& target);
    std::uint64_t settledTurn() const;
    void work();
    void change();
    bool settleOther(std::unique_lock<std::mutex>& lock);

    std::filesystem::path folder_;
    OnTrouble on_trouble_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::array<Turn, 2> turns_;
    std::uint64_t turn_ = 2;   ///< copies come into turns_[turn_ % 2]; the other is being settled, or free
    std::uint64_t asked_ = 0;  ///< this turn and those before are waited for
    int failures_ = 0;
    bool ending_ = false;
    std::thread thread_;
};

}  // namespace vicon::ingest
