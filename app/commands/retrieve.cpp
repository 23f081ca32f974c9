#include <cstdio>

#include "../command.h"
#include "../fetching.h"
#include "../peers.h"
#include "../progress_line.h"
#include "vicon/core/error.h"
#include "vicon/core/printable.h"
#include "vicon/ingest/query.h"
#include "vicon/ingest/receiver.h"

namespace vicon::app {
namespace {

struct Request {
    std::string peer, study_uid;
    std::optional<ingest::RetrieveMethod> method;  ///< none: the peer's
    bool reports = false;                          ///< in place of images
};

int retrieve(Context& context, const Request& request)
{
    if (!ingest::isLikeUid(request.study_uid))  // an archive may take another text for every study
        throw Error(ErrorCode::wrong_use, "'" + printable(request.study_uid) + "' is no Study Instance UID", "STUDY",
                    "'vicon query " + request.peer + "' prints them");
    ingest::Peer peer = requirePeer(context.config(), request.peer, PeerUse::query);
    peer.retrieve = request.method.value_or(peer.retrieve);
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
    const Fetched fetched = fetchSeries(context, request.study_uid, peer, series, progress);
    if (fetched.by_listener)
        waitForListener(context, progress);
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
                command.option("--method", request->method,
                               "get: over our own association; move: the PACS sends to receive.port of "
                               "receive.address, to 'vicon receive' where it runs, and must know receive.ae_title; "
                               "else as [peers] says");
                command.flag("--reports", request->reports,
                             "Its structured reports in place of images: earlier reports for 'vicon priors'");
                return [request](Context& context) { return retrieve(context, *request); };
            }};
}

}  // namespace vicon::app
