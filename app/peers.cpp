#include "peers.h"

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

}  // namespace vicon::app
