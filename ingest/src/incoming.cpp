#include "incoming.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>

#include "study_key.h"
#include "trial_record.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/file_modes.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr auto kIncomingLook = std::chrono::milliseconds(200);  // how often quiet studies are looked for

}  // namespace

Incoming::Incoming(fs::path folder, Pauses pauses, const Receiver::Handlers& handlers)
    : folder_(std::move(folder)), pauses_(pauses), handlers_(handlers)
{
    makePrivateFolder(folder_);
    lockFolder();
    journal_ = std::make_unique<ArrivalJournal>(folder_, [this](const std::string& what) { trouble(what); });
    findLeftovers();
}

Incoming::~Incoming()
{
    finish();
    journal_.reset();
    ::close(lock_descriptor_);
}

void Incoming::lockFolder()
{
    lock_descriptor_ = openOrMake(folder_ / kReceiverLock);
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
            batches_[uidsOf(file).study].files.push_back(file);
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

fs::path Incoming::open(const std::string& caller)
{
    const std::lock_guard lock(mutex_);
    std::string name;
    for (const char c : nowUtc())
        if (c != ':' && c != '-')
            name += c;
    const fs::path folder = folder_ / (name + "-" + std::to_string(::getpid()) + "-" + std::to_string(count_++));
    callers_[folder] = caller;
    return *open_.insert(folder).first;
}

int Incoming::waitingOf(const std::string& caller)
{
    const std::lock_guard lock(mutex_);
    const auto found = waiting_.find(caller);
    return found == waiting_.end() ? 0 : found->second;
}

void Incoming::add(const fs::path& folder, const fs::path& received, const fs::path& file, const std::string& study)
{
    journal_->keep(received, file);
    const std::lock_guard lock(mutex_);
    Batch& batch = batches_[study];
    batch.files.push_back(file);
    batch.open.insert(folder);
    batch.last = std::chrono::steady_clock::now();
    batch.missing = batch.asked = 0;
    ++waiting_[callers_[folder]];
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
        if (!fs::exists(folder))
            callers_.erase(folder);
    }
    changed_.notify_all();
}

void Incoming::trouble(const std::string& what) const
{
    if (handlers_.on_trouble)
        handlers_.on_trouble(what);
}

void Incoming::work()
{
    std::unique_lock lock(mutex_);
    for (;;) {
        while (!told_to_stop_ && handOverOne(lock)) {
        }
        if (finishing_)
            return;
        changed_.wait_for(lock, kIncomingLook);
    }
}

}  // namespace vicon::ingest
