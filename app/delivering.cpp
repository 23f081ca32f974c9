#include "delivering.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <thread>

#include "command.h"
#include "peers.h"
#include "vicon/cases/store_presence.h"
#include "vicon/ingest/receiver.h"

namespace vicon::app {

ingest::Delivery deliveryFor(const Config& config)
{
    return {.options = config.get<OutboxOptions>(),
            .peer = [&config](const std::string& name) { return requirePeer(config, name, PeerUse::send); },
            .our_ae_title = config.get<ingest::ReceiverOptions>().ae_title};
}

void deliverInBackground(const StorePlace& place, const Config& config)
{
    constexpr auto kLook = std::chrono::milliseconds(25), kAfterTrouble = std::chrono::milliseconds(1000);
    ingest::Delivery delivery = deliveryFor(config);
    delivery.trouble = [](const std::string& what) { spdlog::warn("outbox: {}", what); };
    std::string said;
    while (!stopRequested()) {
        try {
            CaseStore store = openAgain(place);
            Outbox outbox(store.database(), delivery.options);
            UntilStopped quiet;
            while (!stopRequested()) {
                requireThere(place);
                const auto next = outbox.nextDue();
                if (const int due = next && *next <= outbox.now() ? ingest::deliverDue(store, delivery, {}, quiet) : 0;
                    due > 0)
                    spdlog::info("outbox: {} objects were due", due);
                said.clear();
                std::this_thread::sleep_for(kLook);
            }
        } catch (const std::exception& e) {
            if (e.what() != said && !stopRequested())
                spdlog::error("the outbox waits: {}", said = e.what());
            std::this_thread::sleep_for(kAfterTrouble);
        }
    }
}

}  // namespace vicon::app
