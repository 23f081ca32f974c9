#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <map>
#include <set>
#include <thread>

#include "../command.h"
#include "../delivering.h"
#include "../peers.h"
#include "../progress_line.h"
#include "vicon/cases/report_versions.h"
#include "vicon/cases/whole_id.h"
#include "vicon/core/error.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

struct SendArguments {
    std::string case_id, peer;
    bool images = false;
    bool later = false;
    double wait_s = 10;
};

/// The images as they came, those of every scan.
std::vector<OutboxObject> sourceImages(CaseStore& store, const std::string& case_id)
{
    std::vector<OutboxObject> objects;
    for (const ScanRecord& scan : store.scans(case_id))
        for (const InstanceRecord& instance : store.instances(case_id, scan.id))
            objects.push_back(ingest::outboxObject(store.scanFolder(case_id, scan.id) / "dicom" / instance.file));
    return objects;
}

/// The objects of the report that was signed last.
std::vector<OutboxObject> reportObjects(CaseStore& store, const std::string& case_id)
{
    std::vector<OutboxObject> objects;
    const std::vector<ReportVersion> versions = reportVersions(store, case_id);
    const auto last = std::find_if(versions.rbegin(), versions.rend(), [](const auto& v) { return v.isSigned(); });
    if (last != versions.rend())
        for (const fs::path& file : requireObjects(*last))
            objects.push_back(ingest::outboxObject(file));
    return objects;
}

bool waits(const OutboxItem& item)
{
    return item.state == DeliveryState::sending || item.state == DeliveryState::sent;
}

/// The items as they are when each was answered for, or the time is over.
std::vector<OutboxItem> awaitAnswers(CaseStore& store, const std::vector<OutboxItem>& queued, double wait_s)
{
    constexpr auto kLook = std::chrono::milliseconds(100);
    Outbox outbox(store.database(), {});
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(wait_s);
    for (;;) {
        std::vector<OutboxItem> items;
        for (const OutboxItem& one : queued)
            if (const auto item = outbox.find(one.id))
                items.push_back(*item);
        const bool some_wait = std::any_of(items.begin(), items.end(), waits);
        if (!some_wait || std::chrono::steady_clock::now() > end || stopRequested())
            return items;
        std::this_thread::sleep_for(kLook);
    }
}

void print(const std::vector<OutboxItem>& items, const std::string& peer)
{
    std::map<DeliveryState, int> counts;
    for (const OutboxItem& item : items)
        ++counts[item.state];
    std::printf("%zu objects for %s: %s\n", items.size(), peer.c_str(), deliveryInBrief(counts).c_str());
    std::set<std::string> said;
    for (const OutboxItem& item : items)
        if (!item.delivered() && !item.reason.empty() && said.insert(item.reason).second)
            std::printf("  %s: %s\n", nameOf(item.state).c_str(), item.reason.c_str());
    if (counts.contains(DeliveryState::sent))
        std::printf("  'vicon receive' takes the peer's answer; 'vicon outbox' shows it\n");
    if (counts.contains(DeliveryState::queued))
        std::printf("  'vicon receive' or another 'vicon send' tries again\n");
}

int send(Context& context, const SendArguments& a)
{
    CaseStore& store = context.existingStore();
    const std::string case_id = requireCase(store, a.case_id, IdPart::whole).id;
    requirePeer(context.config(), a.peer, PeerUse::send);
    std::vector<OutboxObject> objects = reportObjects(store, case_id);
    if (a.images)
        std::ranges::copy(sourceImages(store, case_id), std::back_inserter(objects));
    if (objects.empty())
        throw Error(ErrorCode::not_found, "the case has no signed report to send", case_id,
                    "'vicon sign' makes one; --images sends the images");
    std::vector<OutboxItem> items = queueObjects(store, case_id, a.peer, objects);
    if (!a.later) {
        ProgressLine progress("send");
        const ingest::Delivery delivery = deliveryFor(context.config());
        ingest::deliverDue(store, delivery, {.case_id = case_id, .peer = a.peer}, progress);
        items = awaitAnswers(store, items, a.wait_s);
        progress.clear();
    }
    if (context.json) {
        nlohmann::json list = nlohmann::json::array();
        for (const OutboxItem& item : items)
            list.push_back(toJson(item));
        std::printf("%s\n", nlohmann::json{{"items", list}}.dump(2).c_str());
    } else {
        print(items, a.peer);
    }
    const bool on_its_way = std::all_of(items.begin(), items.end(),
                                        [&](const OutboxItem& i) { return i.delivered() || waits(i) || a.later; });
    return on_its_way ? 0 : 1;
}

}  // namespace

Subcommand sendCommand()
{
    return {"send",
            "Send a case's signed report to a PACS, through the outbox: PDF, measurements (SR), lumen, pictures",
            [](CommandLine& command) {
                auto a = std::make_shared<SendArguments>();
                command.option("CASE", a->case_id, "The case's whole id").required();
                command.option("PEER", a->peer, "Name of a peer in the configuration").required();
                command.flag("--images", a->images, "Also its images, as they came");
                const auto later =
                    command.flag("--later", a->later, "Only queue them; 'vicon receive' delivers in the background");
                command.option("--wait", a->wait_s, "Seconds to wait for the peer to commit to them")
                    .typeName("SECONDS")
                    .check(range(0.0, 86400.0))
                    .captureDefault()
                    .excludes(later);
                return [a](Context& context) { return send(context, *a); };
            }};
}

}  // namespace vicon::app
