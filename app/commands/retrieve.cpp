#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>

#include "../command.h"
#include "../fetching.h"
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
    bool reports = false;  ///< in place of images
};

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
    const ingest::ReceiverOptions options = context.config().get<ingest::ReceiverOptions>();
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

int retrieve(Context& context, const Request& request)
{
    const ingest::Peer peer = requirePeer(context.config(), request.peer, PeerUse::query);
    const std::string title = context.config().get<ingest::ReceiverOptions>().ae_title;
    ProgressLine progress("retrieve");
    std::vector<std::string> series;
    for (const char* modality : request.reports ? std::vector{"SR"} : std::vector{"CT", "MR"})
        for (std::string& uid : ingest::findSeries(peer, request.study_uid, modality, title, progress))
            series.push_back(std::move(uid));
    if (series.empty())
        throw Error(ErrorCode::not_found,
                    request.reports ? "the peer has no structured report of this study"
                                    : "the peer has no series of CT or MR of this study",
                    request.study_uid, "look for it with 'vicon query " + request.peer + "'");
    const Fetched fetched = request.method == "get" ? fetchByGet(context, request.study_uid, peer, series, progress)
                                                    : fetchByMove(context, request, peer, series, progress);
    const ingest::RetrieveResult& result = fetched.result;
    const ingest::ImportReport& report = fetched.report;
    progress.clear();
    if (context.json) {
        nlohmann::json lines = nlohmann::json::array();
        for (const ingest::ImportLine& line : report.lines)
            lines.push_back(toJson(line));
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
    return {"retrieve", "Fetch the CT series or the reports of a study from a PACS (C-GET or C-MOVE) and import them",
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
                command.flag("--reports", request->reports,
                             "Its structured reports in place of images: earlier reports for 'vicon priors'");
                return [request](Context& context) { return retrieve(context, *request); };
            }};
}

}  // namespace vicon::app
