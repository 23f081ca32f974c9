#include "ordering.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <map>
#include <thread>

#include "command.h"
#include "peers.h"
#include "vicon/cases/store_presence.h"
#include "vicon/core/error.h"
#include "vicon/ingest/orders.h"
#include "vicon/ingest/receiver.h"

namespace vicon::app {
namespace {

using Clock = std::chrono::steady_clock;

/// Asks for each case that waits for its order, each when its time has come.
class Asking {
public:
    Asking(const StorePlace& place, const Config& config)
        : store_(openAgain(place)),
          options_(config.get<ingest::OrderOptions>()),
          peer_(requirePeer(config, options_.peer, PeerUse::query)),
          title_(config.get<ingest::ReceiverOptions>().ae_title)
    {
    }

    void look()
    {
        requireThere(store_.place());
        for (const CaseRecord& c : ingest::casesToAskFor(store_, options_)) {
            if (stopRequested() || Clock::now() < next_[c.id])
                continue;
            next_[c.id] = Clock::now() +
                          std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.poll_s));
            ask(c.id);
        }
    }

private:
    void ask(const std::string& case_id)
    {
        UntilStopped quiet;
        const auto outcome = ingest::takeOrder(store_, case_id, peer_, options_, title_, quiet);
        if (!outcome.order)
            return;
        spdlog::info("case {}: order found at {}, {} taken, {} flagged", case_id, peer_.name, outcome.taken.size(),
                     outcome.flagged.size());
        next_.erase(case_id);
    }

    CaseStore store_;
    const ingest::OrderOptions options_;
    const ingest::Peer peer_;
    const std::string title_;
    std::map<std::string, Clock::time_point> next_;
};

}  // namespace

void askForOrdersInBackground(const StorePlace& place, const Config& config)
{
    constexpr auto kLook = std::chrono::milliseconds(500), kAfterTrouble = std::chrono::milliseconds(5000);
    const bool asked_for = !config.get<ingest::OrderOptions>().peer.empty();
    const auto rest = [](auto time) {
        for (const auto end = Clock::now() + time; Clock::now() < end && !stopRequested();)
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
    };
    std::string said;
    const auto say = [&](const std::exception& e) {
        if (e.what() != said && !stopRequested())
            spdlog::warn("orders wait: {}", said = e.what());
    };
    while (asked_for && !stopRequested()) {
        try {
            Asking asking(place, config);
            while (!stopRequested()) {
                try {
                    asking.look();
                    said.clear();
                    rest(kLook);
                } catch (const Error& e) {
                    if (e.code() == ErrorCode::database || e.code() == ErrorCode::store)
                        throw;
                    say(e);  // the next cases are asked for all the same
                    rest(kAfterTrouble);
                }
            }
        } catch (const std::exception& e) {
            say(e);
            rest(kAfterTrouble);
        }
    }
}

}  // namespace vicon::app
