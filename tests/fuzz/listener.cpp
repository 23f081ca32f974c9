// A listener for the PDU layer's harness: VICON's receiver and import, instrumented, with short limits. Prints its
// port, and ends in order when its standard input is closed.
#include <unistd.h>

#include <cstdio>
#include <thread>

#include "vicon/cases/case_store.h"
#include "vicon/ingest/commitment.h"
#include "vicon/ingest/import.h"
#include "vicon/ingest/receiver.h"

using namespace vicon;

int main(int count, char** arguments)
{
    if (count != 2)
        return 2;
    CaseStore store(arguments[1]);
    ingest::ReceiverOptions options;
    options.port = 0;
    options.quiet_s = 0.2;
    options.idle_s = 0.5;
    options.request_s = 1;
    options.timeout_s = 1;
    options.max_associations = options.max_per_host = 500;  // all of them come from here
    NoProgress quiet;
    std::atomic<bool> stop = false;
    ingest::Receiver receiver(options, store.folder() / "incoming",
                              {.on_received = [&](const ingest::Receiver::Files& files) -> ingest::Receiver::Files {
                                   return ingest::importPaths(store, files, {}, quiet).not_stored;
                               },
                               .on_commitment = [](const ingest::CommitmentReport&) {},
                               .on_demand =
                                   [&](const ingest::CommitmentDemand& demand) {
                                       CaseStore own(store.place());
                                       return ingest::commitTo(own, demand, quiet);
                                   }});
    std::printf("%d\n", receiver.port());
    std::fflush(stdout);
    std::thread end([&] {
        char byte = 0;
        while (::read(STDIN_FILENO, &byte, 1) > 0) {
        }
        stop = true;
    });
    receiver.run(stop);
    end.join();
    return 0;
}
