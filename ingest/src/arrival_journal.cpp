#include "arrival_journal.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <set>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/file_modes.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr const char* kParts[] = {"arrivals-1.journal", "arrivals-2.journal"};
/// All of a part: each waits for the disk, which flushes those that wait at once in the time of one. The fewer flushes,
/// the less do those wait whose copies are flushed meanwhile.
constexpr std::size_t kFlushedAtOnce = 32;
constexpr auto kSettleAgain = std::chrono::seconds(1);

/// The disk begins with it, and nobody waits.
void beginToFlush(const fs::path& file)
{
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        return;
    ::sync_file_range(descriptor, 0, 0, SYNC_FILE_RANGE_WRITE);
    ::close(descriptor);
}

/// As flushToDisk(); nothing is wrong with what is not there any more.
int flushOne(const fs::path& path)
{
    const int number = flushToDisk(path);
    return number == ENOENT ? 0 : number;
}

/// Flushes files and the folders that they lie in. Throws Error{store}.
void flushAll(const std::vector<fs::path>& files)
{
    std::set<fs::path> all(files.begin(), files.end());
    for (const fs::path& file : files) {  // with all before one is waited for
        all.insert(file.parent_path());
        beginToFlush(file);
    }
    const std::vector<fs::path> paths(all.begin(), all.end());
    std::atomic<std::size_t> next = 0;
    std::atomic<int> error = 0;
    std::vector<std::thread> threads;
    for (std::size_t n = 0; n < std::min(kFlushedAtOnce, paths.size()); ++n)
        threads.emplace_back([&] {
            for (std::size_t one = next++; one < paths.size(); one = next++)
                if (const int number = flushOne(paths[one]); number != 0)
                    error = number;
        });
    for (std::thread& thread : threads)
        thread.join();
    if (error != 0)
        throw Error(ErrorCode::store,
                    "received files cannot be flushed to disk (" + std::string(std::strerror(error)) + ")");
}

}  // namespace

ArrivalJournal::ArrivalJournal(fs::path folder, OnTrouble on_trouble)
    : folder_(std::move(folder)),
      on_trouble_(std::move(on_trouble)),
      turns_{Turn(folder_ / kParts[0]), Turn(folder_ / kParts[1])}
{
    for (const char* part : kParts)
        restoreCopies(folder_ / part, folder_);
    for (const char* part : kParts)
        fs::remove(folder_ / part);
    thread_ = std::thread([this] { work(); });
}

ArrivalJournal::~ArrivalJournal()
{
    bool settled = true;
    try {
        settle();
    } catch (const std::exception&) {
        settled = false;  // the next one puts them back
    }
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
    std::error_code ignored;
    for (const char* part : kParts)
        if (settled)
            fs::remove(folder_ / part, ignored);
}

/// Where a copy goes; null when there is no place for it. Does not wait: while the other part is being settled, the
/// disk has enough to do.
ArrivalJournal::Turn* ArrivalJournal::turnFor(std::uint64_t bytes, std::uint64_t& place)
{
    const std::lock_guard lock(mutex_);
    if (!JournalPart::mayHold(bytes))
        return nullptr;
    if (!current().part.hasRoomFor(bytes) && other().settled)
        change();
    Turn& turn = current();
    if (!turn.part.hasRoomFor(bytes))
        return nullptr;
    place = turn.part.reserve(bytes);
    turn.settled = false;
    ++turn.writers;
    return &turn;
}

void ArrivalJournal::change()
{
    ++turn_;
    changed_.notify_all();
}

/// Whether a durable copy of it is in the journal, and it has its name.
bool ArrivalJournal::isCopied(const fs::path& temporary, const fs::path& target)
{
    Turn* turn = nullptr;
    bool copied = false;
    try {
        const std::uint64_t bytes = fs::file_size(temporary);
        std::uint64_t place = 0;
        turn = turnFor(bytes, place);
        if (turn) {
            turn->part.copy(temporary, bytes, place, target.lexically_relative(folder_).string());
            ::chmod(temporary.c_str(), fileModeIn(folder_));
            fs::rename(temporary, target);
            copied = true;
        }
    } catch (const std::exception&) {  // the file itself is flushed then, or says what is wrong
    }
    if (turn) {
        const std::lock_guard lock(mutex_);
        if (copied)
            turn->kept.push_back(target);
        if (--turn->writers == 0 && turn != &current())
            changed_.notify_all();
    }
    return copied;
}

void ArrivalJournal::keep(const fs::path& temporary, const fs::path& target)
{
    if (!isCopied(temporary, target))
        replaceFile(target, [&](const fs::path& flushed) { fs::rename(temporary, flushed); });
}

/// The last turn that is settled, and all before.
std::uint64_t ArrivalJournal::settledTurn() const
{
    return other().settled ? (current().settled ? turn_ : turn_ - 1) : turn_ - 2;
}

void ArrivalJournal::settle()
{
    std::unique_lock lock(mutex_);
    const std::uint64_t mine = current().settled ? turn_ - 1 : turn_;
    const int failures = failures_;
    asked_ = std::max(asked_, mine);
    changed_.notify_all();
    changed_.wait(lock, [&] { return settledTurn() >= mine || failures_ != failures; });
    if (settledTurn() < mine)
        throw Error(ErrorCode::store, "received files cannot be flushed to disk", folder_.string());
}

void ArrivalJournal::work()
{
    std::unique_lock lock(mutex_);
    for (;;) {
        if (!other().settled && other().writers == 0) {
            if (settleOther(lock))
                continue;
            if (ending_)
                return;
            changed_.wait_for(lock, kSettleAgain, [&] { return ending_; });
        } else if (other().settled && !current().settled && asked_ >= turn_) {
            change();
        } else if (ending_) {
            return;
        } else {
            changed_.wait(lock);
        }
    }
}

bool ArrivalJournal::settleOther(std::unique_lock<std::mutex>& lock)
{
    Turn& turn = other();
    const std::vector<fs::path> files = turn.kept;
    const bool empty = asked_ >= turn_ - 1;
    lock.unlock();
    std::string why;
    try {
        flushAll(files);
        if (empty)
            turn.part.clear();
        else
            turn.part.renew();
    } catch (const std::exception& e) {
        why = e.what();
    }
    if (!why.empty() && on_trouble_)
        on_trouble_(why);
    lock.lock();
    if (why.empty()) {
        turn.kept.clear();
        turn.settled = true;
    } else {
        ++failures_;
    }
    changed_.notify_all();
    return why.empty();
}

}  // namespace vicon::ingest
