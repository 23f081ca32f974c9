#include <chrono>
#include <cstdio>
#include <optional>
#include <thread>

#include "../audit_forwarding.h"
#include "../command.h"
#include "../delivering.h"
#include "../metrics.h"
#include "../named_options.h"
#include "../operation_audit.h"
#include "../ordering.h"
#include "../peers.h"
#include "../progress_line.h"
#include "../scan_work.h"
#include "spdlog/spdlog.h"
#include "vicon/cases/store_presence.h"
#include "vicon/core/error.h"
#include "vicon/ingest/completeness.h"
#include "vicon/ingest/import.h"
#include "vicon/ingest/orders.h"
#include "vicon/ingest/receiver.h"
#include "vicon/pipeline/worker.h"

namespace vicon::app {
namespace {

/// Works on the queue in the background, over a store connection of its own, until told to stop. Whatever goes wrong
/// with the store is said and tried again.
void workInBackground(const StorePlace& place, const Config& config)
{
    constexpr auto kPause = std::chrono::seconds(10), kLook = std::chrono::seconds(1);
    std::string said;
    while (!stopRequested()) {
        try {
            CaseStore store = openAgain(place);
            said.clear();
            pipeline::WorkerEvents events;
            events.ended = [](const Job& job, JobState state, const std::string& reason) {
                spdlog::log(state == JobState::failed ? spdlog::level::warn : spdlog::level::info, "{}/{}: {}{}",
                            job.case_id, job.scan_id, nameOf(state), reason.empty() ? "" : ", " + reason);
            };
            events.trouble = [](const std::string& what) { spdlog::error("{}", what); };
            pipeline::runWorker(store, config.get<QueueOptions>(), config.get<pipeline::WorkOptions>(),
                                scanWork(store, config), events, stopRequested());
        } catch (const std::exception& e) {
            if (e.what() != said)
                spdlog::error("the worker stopped and starts again: {}", said = e.what());
            for (auto waited = kPause * 0; waited < kPause && !stopRequested(); waited += kLook)
                std::this_thread::sleep_for(kLook);
        }
    }
}

/// Over a store connection of its own: what is received goes into the store that is there now.
ingest::Receiver::Files importReceived(const StorePlace& place, const Config& config,
                                       const ingest::Receiver::Files& files)
{
    CaseStore store = openAgain(place);
    UntilStopped quiet;
    const auto report = ingest::importPaths(store, files, config.get<ingest::ImportOptions>(), quiet);
    using Kind = ingest::ImportLine::Kind;
    for (const ingest::ImportLine& line : report.lines) {
        const bool trouble = line.kind == Kind::refused || line.kind == Kind::quarantined || line.kind == Kind::flagged;
        spdlog::log(trouble ? spdlog::level::warn : spdlog::level::info, "{} {}: {}", ingest::nameOf(line.kind),
                    line.subject, line.text);
    }
    return report.not_stored;
}

/// Over a store connection of its own: reports come on the threads of associations.
void takeCommitment(const StorePlace& place, const OutboxOptions& options, const ingest::CommitmentReport& report)
{
    CaseStore store = openAgain(place);
    Outbox outbox(store.database(), options);
    const int concerned = ingest::noteCommitment(outbox, report);
    spdlog::info("a peer committed to {} objects and not to {}; {} wait in the outbox", report.committed.size(),
                 report.failed.size(), concerned);
}

/// As above: peers ask on the threads of associations.
ingest::CommitmentReport giveCommitment(const StorePlace& place, const ingest::CommitmentDemand& demand)
{
    CaseStore store = openAgain(place);
    const UntilStopped wanted;
    ingest::CommitmentReport report = ingest::commitTo(store, demand, wanted);
    spdlog::info("committed to {} objects, not to {}", report.committed.size(), report.failed.size());
    return report;
}

int receive(Context& context, bool no_work)
{
    const Config& config = context.config();
    const ingest::ReceiverOptions options = config.get<ingest::ReceiverOptions>();
    requireDeliverable(config);
    MetricsServer metrics(context.storePlace(), config);
    const CaseStore store(context.storePlace());  // made where there is none; threads open it again
    std::optional<ingest::Completeness> completeness;
    if (!options.count_at.empty())
        completeness.emplace(store.place(), requirePeer(config, options.count_at, PeerUse::query), options.ae_title);
    if (const auto orders = config.get<ingest::OrderOptions>(); !orders.peer.empty())
        requirePeer(config, orders.peer, PeerUse::query);  // a wrong one is told before anybody waits for it
    ingest::Receiver::OnQuiet missing;
    if (completeness)
        missing = [&](const ingest::Receiver::Files& files) { return completeness->missing(files); };
    RefusedCallers refused(store.place());
    ingest::Receiver receiver(
        options, store.folder() / "incoming",
        {.on_received =
             [&](const ingest::Receiver::Files& files) { return importReceived(store.place(), config, files); },
         .on_trouble = [](const std::string& trouble) { spdlog::warn("{}", trouble); },
         .on_note = [](const std::string& note) { spdlog::info("{}", note); },
         .on_commitment =
             [&](const ingest::CommitmentReport& report) {
                 takeCommitment(store.place(), config.get<OutboxOptions>(), report);
             },
         .on_demand = [&](const ingest::CommitmentDemand& demand) { return giveCommitment(store.place(), demand); },
         .on_quiet = missing,
         .on_refused = [&](const std::string& host, const std::string& line) { refused.note(host, line); }},
        networkOf(config));
    const AuditedRun audited(store.place(), "receive");
    metrics.add(receiver.counts());
    std::printf("listening on port %d of %s\n", receiver.port(), options.address.c_str());
    std::fflush(stdout);
    std::thread worker;
    if (!no_work)
        worker = std::thread(workInBackground, store.place(), config);
    std::thread sender(deliverInBackground, store.place(), config);
    std::thread asker(askForOrdersInBackground, store.place(), config);
    std::thread auditor(forwardAuditInBackground, store.place(), config.get<AuditOptions>());
    receiver.run(stopRequested());
    auditor.join();
    asker.join();
    sender.join();
    if (worker.joinable())
        worker.join();
    return 0;
}

}  // namespace

Subcommand receiveCommand()
{
    return {"receive", "Listen for DICOM (C-ECHO, C-STORE), import what comes, run the queue, and deliver the outbox",
            [](CommandLine& command) {
                auto no_work = std::make_shared<bool>(false);
                auto port = std::make_shared<std::string>(), address = std::make_shared<std::string>();
                command.flag("--no-work", *no_work, "Receive only; another process runs 'vicon work'");
                command.option("--port", *port, "TCP port (receive.port)").typeName("PORT");
                command.option("--address", *address, "Address to listen on (receive.address)").typeName("IPV4");
                return [no_work, port, address](Context& context) {
                    if (!port->empty())
                        context.assignments.push_back("receive.port=" + *port);
                    if (!address->empty())
                        context.assignments.push_back("receive.address=" + *address);
                    return receive(context, *no_work);
                };
            }};
}

}  // namespace vicon::app
