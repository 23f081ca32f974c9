#include <cstdio>

#include "../command.h"
#include "../progress_line.h"
#include "vicon/core/error.h"
#include "vicon/ingest/receiver.h"
#include "vicon/ingest/sender.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

ingest::Peer peerNamed(const Config& config, const std::string& name)
{
    if (!config.peers().contains(name))
        throw Error(ErrorCode::wrong_use, "no such peer in the configuration", name,
                    "add a table [peers." + name + "] with host, port and ae_title");
    const auto& peer = config.peers()[name];
    return {name, peer.value("host", ""), peer.value("ae_title", "ANY-SCP"), peer.value("port", 104)};
}

std::vector<fs::path> objectsOf(CaseStore& store, const std::string& case_id)
{
    std::vector<fs::path> files;
    for (const ScanRecord& scan : store.scans(case_id))
        for (const InstanceRecord& instance : store.instances(case_id, scan.id))
            files.push_back(store.scanFolder(case_id, scan.id) / "dicom" / instance.file);
    return files;
}

int send(Context& context, const std::string& case_id, const std::string& peer_name)
{
    CaseStore& store = context.existingStore();
    const ingest::Peer peer = peerNamed(context.config(), peer_name);
    const auto files = objectsOf(store, store.requireCase(case_id).id);
    ProgressLine progress("send");
    const auto result =
        ingest::storeFiles(peer, files, context.config().get<ingest::ReceiverOptions>().ae_title, progress);
    progress.clear();
    for (const auto& failure : result.failures)
        std::fprintf(stderr, "vicon: %s: %s\n", failure.file.c_str(), failure.reason.c_str());
    std::printf("%d of %zu objects sent to %s\n", result.sent, files.size(), peer.name.c_str());
    return result.complete() ? 0 : 1;
}

}  // namespace

Subcommand sendCommand()
{
    return {"send", "Send a case's objects to a PACS named in the configuration", [](CLI::App& command) {
                auto case_id = std::make_shared<std::string>(), peer = std::make_shared<std::string>();
                command.add_option("CASE", *case_id, "The case's id")->required();
                command.add_option("PEER", *peer, "A peer of the configuration")->required();
                return [case_id, peer](Context& context) { return send(context, *case_id, *peer); };
            }};
}

}  // namespace vicon::app
