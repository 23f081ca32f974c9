#include <unistd.h>

#include <atomic>
#include <cstdio>
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

/// A folder in the store that is gone when the retrieval is over, however it ends.
class ArrivalFolder {
public:
    explicit ArrivalFolder(const fs::path& store) : path_(store / ("retrieve-" + std::to_string(::getpid())))
    {
        makePrivateFolder(path_);
    }
    ~ArrivalFolder()
    {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    ArrivalFolder(const ArrivalFolder&) = delete;
    ArrivalFolder& operator=(const ArrivalFolder&) = delete;
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

/// Runs a receiver for as long as a peer sends to it. What arrives stays in the receiver's folder; the import takes it.
class Listening {
public:
    Listening(const ingest::ReceiverOptions& options, const fs::path& incoming,
              ingest::Receiver::OnReceived on_received)
        : receiver_(options, incoming, std::move(on_received)), thread_([this] { receiver_.run(stop_); })
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

ingest::ImportReport fetch(Context& context, const Request& request, const ingest::Peer& peer,
                           const std::vector<std::string>& series, ingest::RetrieveResult& result, Progress& progress)
{
    const auto options = context.config().get<ingest::ReceiverOptions>();
    const auto import_options = context.config().get<ingest::ImportOptions>();
    CaseStore& store = context.store();
    if (request.method == "get") {
        const ArrivalFolder arrival(store.folder());
        result = ingest::getSeries(peer, request.study_uid, series, arrival.path(), options.ae_title, progress);
        return ingest::importPaths(store, {arrival.path()}, import_options, progress);
    }
    ingest::ImportReport report;
    Listening listening(options, store.folder() / "incoming", [&](const std::vector<fs::path>& files) {
        CaseStore own(store.folder());  // the receiver hands over on its own thread
        NoProgress quiet;
        addTo(report, ingest::importPaths(own, files, import_options, quiet));
    });
    result = ingest::moveSeries(peer, request.study_uid, series, options.ae_title, options.ae_title, progress);
    listening.finish();
    return report;
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
    ingest::RetrieveResult result;
    const ingest::ImportReport report = fetch(context, request, peer, series, result, progress);
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
    return result.failed == 0 && report.anythingStored() ? 0 : 1;
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
                            "get: over our own association; move: the PACS sends to receive.port, which must be "
                            "free, and must know receive.ae_title")
                    .check(oneOf({"get", "move"}))
                    .captureDefault();
                return [request](Context& context) { return retrieve(context, *request); };
            }};
}

}  // namespace vicon::app
