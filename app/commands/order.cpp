#include <cstdio>

#include "../command.h"
#include "../peers.h"
#include "vicon/cases/whole_id.h"
#include "vicon/core/error.h"
#include "vicon/ingest/orders.h"
#include "vicon/ingest/receiver.h"

namespace vicon::app {
namespace {

std::string joined(const std::vector<std::string>& words)
{
    std::string all;
    for (const std::string& word : words)
        all += (all.empty() ? "" : ", ") + word;
    return all;
}

void print(const std::string& case_id, const ingest::OrderOutcome& outcome)
{
    std::printf("case %s: %s\n", case_id.c_str(),
                !outcome.order          ? "no order of its own in the worklist"
                : outcome.taken.empty() ? "its order was found, nothing was missing"
                                        : ("taken: " + joined(outcome.taken)).c_str());
    for (const std::string& line : outcome.flagged)
        std::printf("  ! %s\n", line.c_str());
}

int order(Context& context, const std::string& case_id)
{
    const auto options = context.config().get<ingest::OrderOptions>();
    if (options.peer.empty())
        throw Error(ErrorCode::wrong_use, "no modality worklist is configured", "orders.peer",
                    "set it to the name of a peer");
    const ingest::Peer peer = requirePeer(context.config(), options.peer, PeerUse::query);
    const std::string title = context.config().get<ingest::ReceiverOptions>().ae_title;
    CaseStore& store = context.existingStore();
    const std::vector<CaseRecord> cases = case_id.empty() ? ingest::casesToAskFor(store, options)
                                                          : std::vector{requireCase(store, case_id, IdPart::whole)};
    nlohmann::json list = nlohmann::json::array();
    UntilStopped progress;
    for (const CaseRecord& c : cases) {
        const auto outcome = ingest::takeOrder(store, c.id, peer, options, title, progress);
        nlohmann::json entry = {{"case", c.id}, {"taken", outcome.taken}, {"flagged", outcome.flagged}};
        entry["order"] = outcome.order ? nlohmann::json(*outcome.order) : nlohmann::json();
        list.push_back(std::move(entry));
        if (!context.json)
            print(c.id, outcome);
    }
    if (context.json)
        std::printf("%s\n", nlohmann::json{{"cases", list}}.dump(2).c_str());
    else if (cases.empty())
        std::printf("no case waits for its order\n");
    return 0;
}

}  // namespace

Subcommand orderCommand()
{
    return {"order",
            "Ask a modality worklist (orders.peer) for the orders of new cases, and take what their images do not say",
            [](CommandLine& command) {
                auto case_id = std::make_shared<std::string>();
                command.option("CASE", *case_id, "Only this case, whether or not it has an order");
                return [case_id](Context& context) { return order(context, *case_id); };
            }};
}

}  // namespace vicon::app
