// From the incoming folder to whoever takes what was received.

#include <algorithm>
#include <cmath>
#include <utility>

#include "incoming.h"
#include "kept_name.h"
#include "trial_record.h"
#include "vicon/cases/case_store.h"
#include "vicon/cases/store_locks.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr double kFirstRetry_s = 1, kLongestRetry_s = 300;
constexpr int kMostDeaths = 2;  // of processes that were taking one file alone

/// Whether the trouble lies around the objects (disk, database, memory), so that the same again may succeed.
bool mayPass(ErrorCode code)
{
    return code == ErrorCode::store || code == ErrorCode::database || code == ErrorCode::no_memory;
}

std::chrono::steady_clock::time_point soon(double wait_s)
{
    return std::chrono::steady_clock::now() +
           std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(wait_s));
}

double backOff(int times)
{
    return std::min(kLongestRetry_s, kFirstRetry_s * std::pow(2, times - 1));
}

std::string dateToday()
{
    std::string date = nowUtc().substr(0, 10);
    std::erase(date, '-');
    return date;
}

}  // namespace

bool Incoming::isReady(const Batch& batch) const
{
    const auto now = std::chrono::steady_clock::now();
    if (batch.files.empty() || (now < batch.not_before && !finishing_))
        return false;
    if (finishing_)
        return batch.failures == 0 && batch.missing == 0;  // once more would be too much; the next run goes on
    const std::chrono::duration<double> pause(batch.open.empty() ? pauses_.quiet_s : pauses_.idle_s);
    return now - batch.last >= pause;
}

/// Whether objects of it are known to be missing and may still come. Asked again later each time.
bool Incoming::waitsForMore(const std::string& study, Batch& batch)
{
    batch.missing = 0;
    if (!handlers_.on_quiet)
        return false;
    const auto now = std::chrono::steady_clock::now();
    if (batch.asked == 0)
        batch.incomplete_since = now;
    const std::chrono::duration<double> waited = now - batch.incomplete_since;
    try {
        batch.missing = handlers_.on_quiet(batch.files);
    } catch (const std::exception& e) {
        trouble(std::string("a study is handed over without being counted: ") + e.what());
    }
    if (batch.missing == 0)
        return false;
    const bool enough = waited.count() >= pauses_.incomplete_s;
    if (batch.asked++ == 0 || enough)
        trouble("case " + CaseStore::caseIdFor(study) + (enough ? " is handed over without " : " waits for ") +
                std::to_string(batch.missing) + " objects that have not come");
    batch.not_before = soon(std::min(pauses_.incomplete_s - waited.count(), backOff(batch.asked)));
    return !enough;
}

/// More of it may have come meanwhile.
void Incoming::putBack(const std::string& study, const Batch& taken)
{
    Batch& again = batches_[study];
    const bool grown = !again.files.empty();
    again.files.insert(again.files.begin(), taken.files.begin(), taken.files.end());
    std::erase_if(again.files, [this](const fs::path& file) { return !fs::exists(file) && isStoreOf(folder_); });
    again.failures = taken.failures;
    again.not_before = taken.not_before;
    if (grown)
        return;
    again.open = taken.open;
    std::erase_if(again.open, [&](const fs::path& folder) { return !open_.contains(folder); });
    again.last = taken.last;
    again.missing = taken.missing;
    again.asked = taken.asked;
    again.incomplete_since = taken.incomplete_since;
}

/// Whether the store is gone; said once. What was received waits for it, and nothing is made in its place.
bool Incoming::isGone()
{
    const bool gone = !isStoreOf(folder_);
    if (gone && !std::exchange(said_gone_, true))
        trouble(std::string("received objects wait: ") + kStoreIsGone);
    said_gone_ = gone;
    return gone;
}

bool Incoming::handOverOne(std::unique_lock<std::mutex>& lock)
{
    const auto ready =
        std::find_if(batches_.begin(), batches_.end(), [&](const auto& entry) { return isReady(entry.second); });
    if (ready == batches_.end() || isGone())
        return false;
    const std::string study = ready->first;
    Batch taken = std::move(ready->second);
    batches_.erase(ready);
    lock.unlock();
    if (waitsForMore(study, taken)) {
        lock.lock();
        putBack(study, taken);
        return true;
    }
    bool done = false;
    try {
        journal_->settle();
        done = take(taken.files, taken.deaths);
    } catch (const std::exception& e) {
        trouble("received objects wait in " + folder_.filename().string() + ": " + e.what());
    }
    Files gone = taken.files;
    if (!done)
        std::erase_if(gone, [this](const fs::path& file) { return fs::exists(file) || !isStoreOf(folder_); });
    forget(gone);
    lock.lock();
    if (done)
        return true;
    taken.missing = 0;
    taken.not_before = soon(backOff(++taken.failures));
    putBack(study, taken);
    return true;
}

/// Another import or a backup may keep the store for long. Whoever is ended while it waits has read nothing: no file is
/// to blame for that.
void Incoming::waitForStore()
{
    class UntilFinishing : public Progress {
    public:
        explicit UntilFinishing(Incoming& incoming) : incoming_(incoming) {}
        void report(double, std::string_view what) override
        {
            if (!std::exchange(said_, true) && incoming_.handlers_.on_note)
                incoming_.handlers_.on_note("received objects wait: " + std::string(what));
        }
        bool cancelled() const override
        {
            const std::lock_guard lock(incoming_.mutex_);
            return incoming_.finishing_;
        }

    private:
        Incoming& incoming_;
        bool said_ = false;
    } progress(*this);
    try {
        const StoreLock free(folder_.parent_path(), progress);
    } catch (const Error&) {  // whoever takes them waits, or says what is wrong
    }
}

bool Incoming::take(const Files& files, int deaths)
{
    if (files.size() == 1 && deaths >= kMostDeaths) {
        quarantine(files, "whoever reads it dies");
        return true;
    }
    waitForStore();
    try {
        const TrialRecord record(folder_, {files, deaths});
        const Files left = handlers_.on_received(files);
        quarantine(left, "no case takes it");
        std::error_code ignored;
        for (const fs::path& file : files)
            fs::remove(file, ignored);
        return true;
    } catch (const Error& e) {
        if (e.code() == ErrorCode::cancelled)
            told_to_stop_ = true;
        if (e.code() == ErrorCode::cancelled)
            return false;
        if (!mayPass(e.code()))
            return takeInHalves(files, e.what());
        trouble(std::to_string(files.size()) + " received objects could not be taken and wait in " +
                folder_.filename().string() + ": " + e.what());
        return false;
    } catch (const std::exception& e) {
        return isStoreOf(folder_) && takeInHalves(files, e.what());
    }
}

/// One bad object does not keep its companions from being taken.
bool Incoming::takeInHalves(const Files& files, const std::string& why)
{
    if (files.size() == 1) {
        quarantine(files, why);
        return true;
    }
    const auto middle = files.begin() + std::ptrdiff_t(files.size() / 2);
    const bool first = take({files.begin(), middle}, 0);
    return (told_to_stop_ ? false : take({middle, files.end()}, 0)) && first;
}

void Incoming::quarantine(const Files& files, const std::string& why)
{
    if (files.empty())
        return;
    const fs::path target = folder_.parent_path() / "quarantine" / "received" / dateToday();
    makePrivateFolder(target);
    constexpr std::size_t kDigits = 32;
    for (const fs::path& file : files) {
        const std::string name = keptNameIn(file.filename().string());
        const fs::path kept =
            target / (name + (name.empty() ? "" : "-") + sha256OfFile(file).substr(0, kDigits) + ".dcm");
        if (fs::exists(kept))
            fs::remove(file);
        else
            fs::rename(file, kept);
    }
    (void)flushToDisk(target);
    trouble(std::to_string(files.size()) + (files.size() == 1 ? " received object was" : " received objects were") +
            " put into quarantine/received/" + dateToday() + ": " + why);
}

void Incoming::forget(const Files& files)
{
    std::set<fs::path> folders;
    const std::lock_guard lock(mutex_);
    for (const fs::path& file : files) {
        folders.insert(file.parent_path());
        // What an earlier run left is nobody's.
        if (const auto caller = callers_.find(file.parent_path()); caller != callers_.end())
            if (const auto waiting = waiting_.find(caller->second); waiting != waiting_.end() && --waiting->second == 0)
                waiting_.erase(waiting);
    }
    std::error_code not_empty;
    for (const fs::path& folder : folders)
        if (!open_.contains(folder) && fs::remove(folder, not_empty))
            callers_.erase(folder);
}

}  // namespace vicon::ingest
