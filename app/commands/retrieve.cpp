#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <set>
#include <thread>

#include "../command.h"
#include "../peers.h"
#include "../progress_line.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/ingest/import.h"
#include "vicon/ingest/query.h"
#include "vicon/ingest/receiver.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

struct Request {
    std::string peer, study_uid, method = "get";
};

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

/// Runs a receiver for as long as a peer sends to it. What arrives stays in the receiver's folder; the import takes it.
class Listening {
public:
    Listening(const ingest::ReceiverOptions& options, const fs::path& incoming,
              ingest::Receiver::OnReceived on_received)
        : receiver_(options, incoming, {.on_received = std::move(on_received)}),
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
    all.set_aside += more.set_aside;
    all.refused += more.refused;
}

std::set<std::string> storedObjects(CaseStore& store, const std::string& study_uid)
{
    std::set<std::string> uids;
    if (const auto known = store.findCaseByStudy(study_uid))
        for (const ScanRecord& scan : store.scans(known->id))
            for (const InstanceRecord& instance : store.instances(known->id, scan.id))
                uids.insert(instance.sop_uid);
    return uids;
}

struct Fetched {
    ingest::RetrieveResult result;
    ingest::ImportReport report;
    bool by_listener = false;  ///< a running listener imports what comes
    bool whole = false;        ///< everything was there before
};

Fetched fetchByGet(Context& context, const Request& request, const ingest::Peer& peer,
                   const std::vector<std::string>& series, Progress& progress)
{
    CaseStore& store = context.store();
    const std::string title = receiverOptions(context.config()).ae_title;
    const ArrivalFolder arrival(store.folder(), request.study_uid);
    const std::set<std::string> have = storedObjects(store, request.study_uid);
    Fetched fetched;
    try {
        fetched.result = ingest::getSeries(peer, request.study_uid, series, arrival.path(), title, progress, have);
    } catch (const Error& e) {
        if (e.code() != ErrorCode::peer || arrival.files() == 0)
            throw;
        throw Error(e.code(), e.what(), request.study_uid,
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

/// Waits until a running listener has taken what lies in its folder.
void waitForListener(const fs::path& incoming, Progress& progress)
{
    constexpr auto kLook = std::chrono::milliseconds(200);
    const auto waiting = [&] {
        std::error_code gone;
        for (const auto& entry : fs::recursive_directory_iterator(incoming, gone))
            if (entry.path().extension() == ".dcm")
                return true;
        return false;
    };
    while (waiting()) {
        progress.check();
        progress.report(1, "the listener imports");
        std::this_thread::sleep_for(kLook);
    }
}

bool listenerRuns(const fs::path& incoming)
{
    const int lock = ::open((incoming / "receiver.lock").c_str(), O_RDWR | O_CLOEXEC);
    const bool held = lock >= 0 && ::flock(lock, LOCK_EX | LOCK_NB) != 0;
    ::close(lock);
    return held;
}

Fetched fetchByMove(Context& context, const Request& request, const ingest::Peer& peer,
                    const std::vector<std::string>& series, Progress& progress)
{
    const ingest::ReceiverOptions options = receiverOptions(context.config());
    CaseStore& store = context.store();
    const fs::path incoming = store.folder() / "incoming";
    Fetched fetched;
    const auto move = [&] {
        fetched.result =
            ingest::moveSeries(peer, request.study_uid, series, options.ae_title, options.ae_title, progress);
    };
    if (listenerRuns(incoming)) {
        fetched.by_listener = true;
        move();
        waitForListener(incoming, progress);
        return fetched;
    }
    Listening listening(options, incoming, [&](const ingest::Receiver::Files& files) {
        CaseStore own(store.folder());  // the receiver hands over on its own thread
        NoProgress quiet;
        auto report = ingest::importPaths(own, files, context.config().get<ingest::ImportOptions>(), quiet);
        addTo(fetched.report, report);
        return report.not_stored;
    });
    move();
    listening.finish();
    return fetched;
}

int retrieve(Context& context, const Request& request)
{
    const ingest::Peer peer = requirePeer(context.config(), request.peer);
    const std::string title = context.config().get<ingest::ReceiverOptions>().ae_title;
    ProgressLine progress("retrieve");
    const auto series = ingest::findSeries(peer, request.study_uid, "CT", title, progress);
    if (series.empty())
        throw Error(ErrorCode::not_found, "the peer has no CT series of this study", request.study_uid,
                    "look for it with 'vicon query " + request.peer + "'");
    const Fetched fetched = request.method == "get" ? fetchByGet(context, request, peer, series, progress)
                                                    : fetchByMove(context, request, peer, series, progress);
    const ingest::RetrieveResult& result = fetched.result;
    const ingest::ImportReport& report = fetched.report;
    progress.clear();
    if (context.json) {
        nlohmann::json lines = nlohmann::json::array();
        for (const ingest::ImportLine& line : report.lines)
            lines.push_back({{"kind", ingest::nameOf(line.kind)},
                             {"subject", line.subject},
                             {"text", line.text},
                             {"case", line.case_id},
                             {"scan", line.scan_id}});
        std::printf("%s\n", nlohmann::json{{"retrieved", result.completed}, {"failed", result.failed}, {"lines", lines}}
                                .dump(2)
                                .c_str());
    } else {
        std::printf("%d objects retrieved, %d failed\n", result.completed, result.failed);
        for (const std::string& reason : result.reasons)
            std::printf("%-11s %s: %s\n", "failed", request.peer.c_str(), reason.c_str());
        for (const ingest::ImportLine& line : report.lines)
            std::printf("%-11s %s: %s\n", ingest::nameOf(line.kind).c_str(), line.subject.c_str(), line.text.c_str());
    }
    if (fetched.by_listener && !context.json)
        std::printf("the running listener imported them\n");
    if (fetched.whole && !context.json)
        std::printf("everything was there already\n");
    const bool there = report.anythingStored() || fetched.whole ||
                       (fetched.by_listener && context.store().findCaseByStudy(request.study_uid));
    return result.failed == 0 && there ? 0 : 1;
}

}  // namespace

Subcommand retrieveCommand()
{
    return {"retrieve", "Fetch the CT series of a study from a PACS (C-GET or C-MOVE) and import them",
            [](CommandLine& command) {
                auto request = std::make_shared<Request>();
                command.option("PEER", request->peer, "Name of a peer in the configuration").required();
                command.option("STUDY", request->study_uid, "Study Instance UID; 'vicon query' prints it").required();
                command
                    .option("--method", request->method,
                            "get: over our own association; move: the PACS sends to receive.port of receive.address, "
                            "to 'vicon receive' where it runs, and must know receive.ae_title")
                    .check(oneOf({"get", "move"}))
                    .captureDefault();
                return [request](Context& context) { return retrieve(context, *request); };
            }};
}

}  // namespace vicon::app
