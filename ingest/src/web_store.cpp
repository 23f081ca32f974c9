#include <algorithm>
#include <cstdio>

#include "outcomes.h"
#include "vicon/core/uid.h"
#include "web_json.h"
#include "web_peer.h"

namespace fs = std::filesystem;

namespace vicon::ingest::web {
namespace {

constexpr const char* kFailedObjects = "00081198";
constexpr const char* kFailureReason = "00081197";
constexpr long kTooManyRequests = 429, kTimeOut = 408, kClientsFault = 400, kServersFault = 500;

/// What STOW-RS says of one object: the status, and the reason in its answer where there is one (PS3.18 10.5.3).
StoreOutcome outcomeOf(const fs::path& file, const WebClient::Answer& answer)
{
    const nlohmann::json about = nlohmann::json::parse(answer.body, nullptr, false);
    const auto failures = WebItem(about).items(kFailedObjects);
    if (answer.good() && failures.empty())
        return {file, true, false, ""};
    const int reason = failures.empty() ? -1 : failures.front().count(kFailureReason);
    if (reason >= 0) {
        char code[8];
        std::snprintf(code, sizeof code, "%04x", unsigned(reason) & 0xffffU);
        const bool taken = isTaken(unsigned(reason));
        return {file, taken, !taken && isForGood(unsigned(reason)),
                taken ? "" : std::string("the peer refused it (status ") + code + ")"};
    }
    const bool for_good = answer.status >= kClientsFault && answer.status < kServersFault &&
                          answer.status != kTimeOut && answer.status != kTooManyRequests;
    return {file, false, for_good, "the peer refused it (" + statusOf(answer) + ")"};
}

/// A text that no object holds.
std::string newBoundary()
{
    std::string text = randomUid();
    std::replace(text.begin(), text.end(), '.', '-');
    return "vicon-" + text;
}

}  // namespace

SendResult storeFiles(const Peer& peer, const std::vector<fs::path>& files, Progress& progress,
                      const OnStored& on_stored)
{
    SendResult result;
    Outcomes outcomes{result, on_stored};
    WebClient client(peer, progress);
    const std::string boundary = newBoundary();
    const std::string type = "multipart/related; type=\"application/dicom\"; boundary=" + boundary;
    const std::string before = "--" + boundary + "\r\nContent-Type: application/dicom\r\n\r\n";
    const std::string after = "\r\n--" + boundary + "--\r\n";
    // One at a time, over one connection: then each is answered for by itself.
    for (std::size_t n = 0; n < files.size(); ++n) {
        if (!fs::is_regular_file(files[n])) {
            outcomes.add({files[n], false, true, "its file is not there"});
            continue;
        }
        outcomes.add(
            outcomeOf(files[n], client.post("/studies", type, "application/dicom+json", before, files[n], after)));
        progress.report(double(n + 1) / double(files.size()), "sending");
    }
    return result;
}

}  // namespace vicon::ingest::web
