#include "peers.h"

#include <sstream>

#include "vicon/core/error.h"

namespace vicon::app {

ingest::Peer requirePeer(const Config& config, const std::string& name)
{
    const nlohmann::json& peers = config.peers();
    if (!peers.contains(name)) {
        std::string known;
        for (const auto& [other, about] : peers.items())
            known += (known.empty() ? "" : ", ") + other;
        throw Error(ErrorCode::wrong_use, "no peer of that name in the configuration", name,
                    known.empty() ? "add [peers] " + name + " = { host = \"...\", port = 104, ae_title = \"...\" }"
                                  : "the configuration knows " + known);
    }
    const nlohmann::json& about = peers.at(name);
    return {name, about.at("host"), about.value("ae_title", name), about.at("port")};
}

ingest::ReceiverOptions receiverOptions(const Config& config)
{
    auto options = config.get<ingest::ReceiverOptions>();
    std::istringstream entries(options.allow);
    std::string allow;
    for (std::string entry; std::getline(entries, entry, ',');) {
        const bool all_peers = entry.find_first_not_of(' ') != std::string::npos &&
                               entry.substr(entry.find_first_not_of(' '), entry.find_last_not_of(' ') + 1) == "peers";
        if (!all_peers)
            allow += (allow.empty() ? "" : ",") + entry;
        else
            for (const auto& [name, about] : config.peers().items()) {
                const ingest::Peer peer = requirePeer(config, name);
                allow += (allow.empty() ? "" : ",") + peer.ae_title + "@" + peer.host;
            }
        if (all_peers && config.peers().empty())
            throw Error(ErrorCode::wrong_use, "receive.allow names the peers, and there are none", "receive.allow",
                        "add [peers] to the configuration");
    }
    options.allow = allow;
    return options;
}

}  // namespace vicon::app
