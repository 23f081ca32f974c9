#include "incoming.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>

#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr auto kLook = std::chrono::milliseconds(200);  // how often idle associations are looked for

}  // namespace

Incoming::Incoming(fs::path folder, double idle_s, Receiver::OnReceived on_received, Receiver::OnTrouble on_trouble)
    : folder_(std::move(folder)),
      idle_(idle_s),
      on_received_(std::move(on_received)),
      on_trouble_(std::move(on_trouble))
{
    makePrivateFolder(folder_);
    lock_descriptor_ = ::open((folder_ / "receiver.lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (lock_descriptor_ < 0 || ::flock(lock_descriptor_, LOCK_EX | LOCK_NB) != 0) {
        if (lock_descriptor_ >= 0)
            ::close(lock_descriptor_);
        throw Error(ErrorCode::store, "another receiver works for this store", folder_.string(),
                    "stop it, or use another store");
    }
    findLeftovers();
}

Incoming::~Incoming()
{
    finish();
    ::close(lock_descriptor_);
}

void Incoming::findLeftovers()
{
    for (const auto& entry : fs::directory_iterator(folder_)) {
        if (!entry.is_directory() || entry.path().filename().string().starts_with(kTemporaryPrefix))
            continue;
        removeTemporaries(entry.path());
        Batch& batch = batches_[entry.path()];
        for (const auto& file : fs::directory_iterator(entry.path()))
            batch.files.push_back(file.path());
        std::sort(batch.files.begin(), batch.files.end());
        batch.closed = true;
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
        for (auto& [folder, batch] : batches_)
            batch.closed = true;
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
    fs::path folder = folder_ / (name + "-" + std::to_string(::getpid()) + "-" + std::to_string(count_++));
    makePrivateFolder(folder);
    batches_[folder].last = std::chrono::steady_clock::now();
    return folder;
}

void Incoming::add(const fs::path& folder, const fs::path& file)
{
    const std::lock_guard lock(mutex_);
    Batch& batch = batches_[folder];
    batch.files.push_back(file);
    batch.last = std::chrono::steady_clock::now();
}

void Incoming::close(const fs::path& folder)
{
    {
        const std::lock_guard lock(mutex_);
        batches_[folder].closed = true;
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
        while (handOverOne(lock)) {
        }
        if (finishing_)
            return;
        changed_.wait_for(lock, kLook);
    }
}

bool Incoming::handOverOne(std::unique_lock<std::mutex>& lock)
{
    const auto now = std::chrono::steady_clock::now();
    const auto ready = std::find_if(batches_.begin(), batches_.end(), [&](const auto& entry) {
        const Batch& batch = entry.second;
        return batch.closed || (!batch.files.empty() && now - batch.last >= idle_);
    });
    if (ready == batches_.end())
        return false;
    const fs::path folder = ready->first;
    const std::vector<fs::path> files = std::move(ready->second.files);
    ready->second.files.clear();
    const bool closed = ready->second.closed;
    if (closed)
        batches_.erase(ready);
    lock.unlock();
    try {
        if (!files.empty())
            on_received_(files);
        std::error_code ignored;
        for (const fs::path& file : files)
            fs::remove(file, ignored);
        if (closed)
            fs::remove(folder, ignored);  // stays when it still holds something
    } catch (const std::exception& e) {
        trouble("received objects could not be taken and wait in " + folder.filename().string() + ": " + e.what());
    }
    lock.lock();
    return true;
}

}  // namespace vicon::ingest
