#include <cstdio>
#include <thread>

#include "../command.h"
#include "../progress_line.h"
#include "../scan_work.h"
#include "spdlog/spdlog.h"
#include "vicon/core/error.h"
#include "vicon/ingest/import.h"
#include "vicon/ingest/receiver.h"
#include "vicon/pipeline/worker.h"

namespace vicon::app {
namespace {

/// Works on the queue in the background, over a store connection of its own, until told to stop.
void workInBackground(const std::filesystem::path& store_folder, const Config& config)
{
    try {
        CaseStore store(store_folder);
        pipeline::WorkerEvents events;
        events.ended = [](const Job& job, JobState state, const std::string& reason) {
            spdlog::info("{}/{}: {}{}", job.case_id, job.scan_id, nameOf(state), reason.empty() ? "" : ", " + reason);
        };
        pipeline::runWorker(store, config.get<QueueOptions>(), config.get<pipeline::WorkOptions>(),
                            scanWork(store, config), events, stopRequested());
    } catch (const std::exception& e) {
        spdlog::error("the worker stopped: {}", e.what());
    }
}

void importReceived(CaseStore& store, const Config& config, const std::vector<std::filesystem::path>& files)
{
    NoProgress quiet;
    const auto report = ingest::importPaths(store, files, config.get<ingest::ImportOptions>(), quiet);
    for (const ingest::ImportLine& line : report.lines)
        spdlog::info("{} {}: {}", ingest::nameOf(line.kind), line.subject, line.text);
}

int receive(Context& context, bool no_work)
{
    const Config& config = context.config();
    CaseStore store(context.storeFolder());  // one of its own: the receiver imports on its own thread
    ingest::Receiver receiver(
        config.get<ingest::ReceiverOptions>(), store.folder() / "incoming",
        [&](const std::vector<std::filesystem::path>& files) { importReceived(store, config, files); },
        [](const std::string& trouble) { spdlog::warn("{}", trouble); });
    std::printf("listening on port %d\n", receiver.port());
    std::fflush(stdout);
    std::thread worker;
    if (!no_work)
        worker = std::thread(workInBackground, context.storeFolder(), config);
    receiver.run(stopRequested());
    if (worker.joinable())
        worker.join();
    return 0;
}

}  // namespace

Subcommand receiveCommand()
{
    return {"receive", "Listen for DICOM (C-ECHO, C-STORE), import what comes, and run the queue",
            [](CommandLine& command) {
                auto no_work = std::make_shared<bool>(false);
                auto port = std::make_shared<std::string>();
                command.flag("--no-work", *no_work, "Receive only; another process runs 'vicon work'");
                command.option("--port", *port, "TCP port (receive.port)").typeName("PORT");
                return [no_work, port](Context& context) {
                    if (!port->empty())
                        context.assignments.push_back("receive.port=" + *port);
                    return receive(context, *no_work);
                };
            }};
}

}  // namespace vicon::app
