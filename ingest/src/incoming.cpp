#include "incoming.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "study_key.h"
#include "trial_record.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr auto kLook = std::chrono::milliseconds(200);  // how often quiet studies are looked for
constexpr double kFirstBackoff_s = 1, kLongestBackoff_s = 300;
constexpr int kMostDeaths = 2;  // of processes that were taking one file alone

/// Whether the trouble lies around the objects (disk, database, memory), so that the same again may succeed.
bool mayPass(ErrorCode code)
{
    return code == ErrorCode::store || code == ErrorCode::database || code == ErrorCode::no_memory;
}

std::string dateToday()
{
    std::string date = nowUtc().substr(0, 10);
    std::erase(date, '-');
    return date;
}

}  // namespace

Incoming::Incoming(fs::path folder, Pauses pauses, Receiver::OnReceived on_received, Receiver::OnTrouble on_trouble)
    : folder_(std::move(folder)),
      pauses_(pauses),
      on_received_(std::move(on_received)),
      on_trouble_(std::move(on_trouble))
{
    makePrivateFolder(folder_);
    lockFolder();
    findLeftovers();
}

Incoming::~Incoming()
{
    finish();
    ::close(lock_descriptor_);
}

void Incoming::lockFolder()
{
    lock_descriptor_ = ::open((folder_ / kReceiverLock).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (lock_descriptor_ >= 0 && ::flock(lock_descriptor_, LOCK_EX | LOCK_NB) == 0)
        return;
    if (lock_descriptor_ >= 0)
        ::close(lock_descriptor_);
    throw Error(ErrorCode::store, "another receiver works for this store", folder_.string(),
                "stop it, or use another store");
}

void Incoming::findLeftovers()
{
    const Trial died = readTrial(folder_);
    const std::set<fs::path> suspects(died.files.begin(), died.files.end());
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder_)) {
        if (!entry.is_directory() || entry.path().filename().string().starts_with(kTemporaryPrefix))
            continue;
        removeTemporaries(entry.path());
        for (const auto& file : fs::directory_iterator(entry.path()))
            found.push_back(file.path());
        std::error_code not_empty;
        fs::remove(entry.path(), not_empty);
    }
    std::sort(found.begin(), found.end());
    const std::size_t half = (suspects.size() + 1) / 2;
    std::size_t suspected = 0;
    for (const fs::path& file : found) {
        if (!suspects.contains(file)) {
            batches_[studyKeyOf(file)].files.push_back(file);
            continue;
        }
        Batch& batch = batches_[suspected++ < half ? "suspects, first half" : "suspects, second half"];
        batch.files.push_back(file);
        if (suspects.size() == 1)
            batch.deaths = died.deaths;
    }
}

void Incoming::start()
{
    thread_ = std::thread([this] { work(); });
}

void Incoming::finish()
{
    {
        const std::lock_guard lock(mutex_);
        finishing_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable())
        thread_.join();
}

fs::path Incoming::open()
{
    const std::lock_guard lock(mutex_);
    std::string name;
    for (const char c : nowUtc())
        if (c != ':' && c != '-')
            name += c;
    return *open_.insert(folder_ / (name + "-" + std::to_string(::getpid()) + "-" + std::to_string(count_++))).first;
}

void Incoming::add(const fs::path& folder, const fs::path& file)
{
    const std::string study = studyKeyOf(file);
    const std::lock_guard lock(mutex_);
    Batch& batch = batches_[study];
    batch.files.push_back(file);
    batch.open.insert(folder);
    batch.last = std::chrono::steady_clock::now();
}

void Incoming::close(const fs::path& folder)
{
    {
        const std::lock_guard lock(mutex_);
        open_.erase(folder);
        for (auto& [study, batch] : batches_)
            batch.open.erase(folder);
        std::error_code not_empty;
        fs::remove(folder, not_empty);
    }
    changed_.notify_all();
}

void Incoming::trouble(const std::string& what) const
{
    if (on_trouble_)
        on_trouble_(what);
}

void Incoming::work()
{
    std::unique_lock lock(mutex_);
    for (;;) {
        while (!told_to_stop_ && handOverOne(lock)) {
        }
        if (finishing_)
            return;
        changed_.wait_for(lock, kLook);
    }
}

bool Incoming::isReady(const Batch& batch) const
{
    const auto now = std::chrono::steady_clock::now();
    if (batch.files.empty() || (now < batch.not_before && !finishing_))
        return false;
    if (finishing_)
        return batch.failures == 0;  // once more would be too much
    const std::chrono::duration<double> pause(batch.open.empty() ? pauses_.quiet_s : pauses_.idle_s);
    return now - batch.last >= pause;
}

bool Incoming::handOverOne(std::unique_lock<std::mutex>& lock)
{
    const auto ready =
        std::find_if(batches_.begin(), batches_.end(), [&](const auto& entry) { return isReady(entry.second); });
    if (ready == batches_.end())
        return false;
    const std::string study = ready->first;
    const Batch taken = std::move(ready->second);
    batches_.erase(ready);
    lock.unlock();
    bool done = false;
    try {
        done = take(taken.files, taken.deaths);
    } catch (const std::exception& e) {
        trouble("received objects wait in " + folder_.filename().string() + ": " + e.what());
    }
    if (done)
        removeEmptyFolders(taken.files);
    lock.lock();
    if (done)
        return true;
    Batch& again = batches_[study];  // more of it may have come meanwhile
    again.files.insert(again.files.begin(), taken.files.begin(), taken.files.end());
    std::erase_if(again.files, [](const fs::path& file) { return !fs::exists(file); });
    again.failures = taken.failures + 1;
    const double wait_s = std::min(kLongestBackoff_s, kFirstBackoff_s * std::pow(2, taken.failures));
    again.not_before =
        std::chrono::steady_clock::now() +
        std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(wait_s));
    return true;
}

bool Incoming::take(const Files& files, int deaths)
{
    if (files.size() == 1 && deaths >= kMostDeaths) {
        quarantine(files, "whoever reads it dies");
        return true;
    }
    try {
        const TrialRecord record(folder_, {files, deaths});
        const Files left = on_received_(files);
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
        return takeInHalves(files, e.what());
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
        const fs::path kept = target / (sha256OfFile(file).substr(0, kDigits) + ".dcm");
        if (fs::exists(kept))
            fs::remove(file);
        else
            fs::rename(file, kept);
    }
    const int descriptor = ::open(target.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    ::fsync(descriptor);
    ::close(descriptor);
    trouble(std::to_string(files.size()) + (files.size() == 1 ? " received object was" : " received objects were") +
            " put into quarantine/received/" + dateToday() + ": " + why);
}

void Incoming::removeEmptyFolders(const Files& files)
{
    std::set<fs::path> folders;
    for (const fs::path& file : files)
        folders.insert(file.parent_path());
    const std::lock_guard lock(mutex_);
    std::error_code not_empty;
    for (const fs::path& folder : folders)
        if (!open_.contains(folder))
            fs::remove(folder, not_empty);
}

}  // namespace vicon::ingest
