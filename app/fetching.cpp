#include "fetching.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iterator>
#include <optional>
#include <set>
#include <thread>

#include "peers.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/ingest/receiver.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

/// A folder of the store for what comes of a study. It stays until all of it was imported, so that a retrieval that
/// broke off, or was killed, goes on where it stopped. One retrieval of a study works at a time.
class ArrivalFolder {
public:
    ArrivalFolder(const fs::path& store, const std::string& study_uid)
        : path_(store / "retrieve" / CaseStore::caseIdFor(study_uid))
    {
        makePrivateFolder(path_);
        lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (lock_ < 0 || ::flock(lock_, LOCK_EX | LOCK_NB) != 0)
            throw Error(ErrorCode::store, "this study is being retrieved by another program", study_uid,
                        "wait until it is done");
    }
    ~ArrivalFolder() { ::close(lock_); }
    ArrivalFolder(const ArrivalFolder&) = delete;
    ArrivalFolder& operator=(const ArrivalFolder&) = delete;
    const fs::path& path() const { return path_; }
    std::size_t files() const
    {
        return std::size_t(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
    }
    void remove() const
    {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }

private:
    fs::path path_;
    int lock_ = -1;
};

std::set<std::string> storedObjects(CaseStore& store, const std::string& study_uid)
{
    std::set<std::string> uids;
    if (const auto known = store.findCaseByStudy(study_uid))
        for (const ScanRecord& scan : store.scans(known->id))
            for (const InstanceRecord& instance : store.instances(known->id, scan.id))
                uids.insert(instance.sop_uid);
    return uids;
}

fs::path incomingOf(const CaseStore& store)
{
    return store.folder() / "incoming";
}

/// Runs a receiver for as long as a peer sends to it. What arrives stays in the receiver's folder; the import takes it.
class Listening {
public:
    Listening(const ingest::ReceiverOptions& options, const fs::path& incoming,
              ingest::Receiver::OnReceived on_received, const ingest::Receiver::Network& network)
        : receiver_(options, incoming, {.on_received = std::move(on_received)}, network),
          thread_([this] { receiver_.run(stop_); })
    {
    }
    ~Listening() { finish(); }
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;
    /// Returns when everything that came was handed over.
    void finish()
    {
        stop_ = true;
        if (thread_.joinable())
            thread_.join();
    }

private:
    std::atomic<bool> stop_ = false;
    ingest::Receiver receiver_;
    std::thread thread_;
};

void addTo(ingest::ImportReport& all, ingest::ImportReport more)
{
    all.lines.insert(all.lines.end(), more.lines.begin(), more.lines.end());
    all.scans_stored += more.scans_stored;
    all.scans_unchanged += more.scans_unchanged;
    all.images_kept += more.images_kept;
    all.reports += more.reports;
    all.set_aside += more.set_aside;
    all.refused += more.refused;
}

bool listenerRuns(const fs::path& incoming)
{
    const int lock = ::open((incoming / "receiver.lock").c_str(), O_RDWR | O_CLOEXEC);
    const bool held = lock >= 0 && ::flock(lock, LOCK_EX | LOCK_NB) != 0;
    ::close(lock);
    return held;
}

Fetched fetchByGet(Context& context, const std::string& study_uid, const ingest::Peer& peer,
                   const std::vector<std::string>& series, Progress& progress)
{
    CaseStore& store = context.store();
    const std::string title = context.config().get<ingest::ReceiverOptions>().ae_title;
    const ArrivalFolder arrival(store.folder(), study_uid);
    const std::set<std::string> have = storedObjects(store, study_uid);
    Fetched fetched;
    try {
        fetched.result = ingest::getSeries(peer, study_uid, series, arrival.path(), title, progress, have);
    } catch (const Error& e) {
        if (e.code() != ErrorCode::peer || arrival.files() == 0)
            throw;
        throw Error(e.code(), e.what(), study_uid,
                    "run the same again: it goes on where it stopped, " + std::to_string(arrival.files()) +
                        " objects are here");
    }
    fetched.whole = arrival.files() == 0 && !have.empty() && fetched.result.failed == 0;
    if (arrival.files() > 0)
        fetched.report =
            ingest::importPaths(store, {arrival.path()}, context.config().get<ingest::ImportOptions>(), progress);
    arrival.remove();
    return fetched;
}

Fetched fetchByMove(Context& context, const std::string& study_uid, const ingest::Peer& peer,
                    const std::vector<std::string>& series, Progress& progress)
{
    const ingest::ReceiverOptions options = context.config().get<ingest::ReceiverOptions>();
    CaseStore& store = context.store();
    const fs::path incoming = incomingOf(store);
    const std::set<std::string> have = storedObjects(store, study_uid);
    Fetched fetched;
    const auto move = [&] {
        fetched.result =
            ingest::moveSeries(peer, study_uid, series, options.ae_title, options.ae_title, progress, have);
        fetched.whole = fetched.result.completed + fetched.result.failed == 0 && !have.empty();
    };
    if (listenerRuns(incoming)) {
        fetched.by_listener = true;
        move();
        return fetched;
    }
    Listening listening(
        options, incoming,
        [&](const ingest::Receiver::Files& files) {
            CaseStore own(store.place());  // the receiver hands over on its own thread
            NoProgress quiet;
            auto report = ingest::importPaths(own, files, context.config().get<ingest::ImportOptions>(), quiet);
            addTo(fetched.report, report);
            return report.not_stored;
        },
        networkOf(context.config()));
    move();
    listening.finish();
    return fetched;
}

/// The objects below a folder; nothing where the listener removed a folder while it was read.
std::optional<std::vector<fs::path>> objectsIn(const fs::path& folder)
{
    std::vector<fs::path> objects;
    std::error_code gone;
    for (fs::recursive_directory_iterator at(folder, gone), end; !gone && at != end; at.increment(gone))
        if (at->path().extension() == ".dcm")
            objects.push_back(at->path());
    return gone ? std::nullopt : std::optional(objects);
}

}  // namespace

Fetched fetchSeries(Context& context, const std::string& study_uid, const ingest::Peer& peer,
                    const std::vector<std::string>& series, Progress& progress)
{
    return peer.retrieve == ingest::RetrieveMethod::get ? fetchByGet(context, study_uid, peer, series, progress)
                                                        : fetchByMove(context, study_uid, peer, series, progress);
}

void waitForListener(Context& context, Progress& progress)
{
    constexpr auto kLook = std::chrono::milliseconds(200);
    const fs::path incoming = incomingOf(context.store());
    auto waiting = objectsIn(incoming);  // what others send meanwhile is not waited for
    while (!waiting && fs::exists(incoming)) {
        progress.check();
        waiting = objectsIn(incoming);
    }
    while (waiting &&
           std::any_of(waiting->begin(), waiting->end(), [](const fs::path& file) { return fs::exists(file); })) {
        progress.check();
        progress.report(1, "the listener imports");
        std::this_thread::sleep_for(kLook);
    }
}

}  // namespace vicon::app
