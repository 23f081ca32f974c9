#include "peers.h"

#include <algorithm>

#include "vicon/core/error.h"

namespace vicon::app {
namespace {

[[noreturn]] void wrong(const std::string& name, const std::string& what, const std::string& remedy)
{
    throw Error(ErrorCode::wrong_use, what, "[peers] " + name, remedy);
}

void takeRoles(ingest::Peer& peer, const nlohmann::json& roles)
{
    constexpr const char* kRemedy = "roles are \"store\" (it may store here), \"query\" (it is asked) and \"send\"";
    constexpr std::pair<bool ingest::Peer::*, const char*> kPeerRoles[] = {
        {&ingest::Peer::stores, "store"},
        {&ingest::Peer::is_queried, "query"},
        {&ingest::Peer::is_sent, "send"},
    };
    for (const auto& [member, name] : kPeerRoles)
        peer.*member = false;
    for (const nlohmann::json& role : roles) {
        const auto known = std::ranges::find_if(kPeerRoles, [&](const auto& one) { return role == one.second; });
        if (known == std::end(kPeerRoles))
            wrong(peer.name, "not a role: " + role.dump(), kRemedy);
        peer.*known->first = true;
    }
}

/// What a peer by DICOMweb has beside. Returns whether this is of it.
bool takeWebField(ingest::Peer& peer, const std::string& field, const nlohmann::json& value)
{
    constexpr std::pair<const char*, std::string ingest::WebAccess::*> kFields[] = {
        {"url", &ingest::WebAccess::url},
        {"user", &ingest::WebAccess::user},
        {"password_file", &ingest::WebAccess::password_file},
    };
    for (const auto& [name, member] : kFields)
        if (field == name && value.is_string()) {
            if (!peer.web)
                peer.web.emplace();
            *peer.web.*member = value;
            return true;
        }
    return false;
}

void takeField(ingest::Peer& peer, const std::string& field, const nlohmann::json& value, const ingest::TlsOptions& tls)
{
    constexpr int kMostPort = 65535, kMostAssociations = 1000;
    constexpr std::size_t kLongestTitle = 16;
    const auto is_within = [&](int lowest, int highest) {
        return value.is_number_integer() && value >= lowest && value <= highest;
    };
    if (field == "host" && value.is_string())
        peer.host = value;
    else if (field == "ae_title" && value.is_string() && !value.get<std::string>().empty() &&
             value.get<std::string>().size() <= kLongestTitle)
        peer.ae_title = value;
    else if (field == "port" && is_within(1, kMostPort))
        peer.port = value;
    else if (field == "roles" && value.is_array())
        takeRoles(peer, value);
    else if (field == "retrieve" && value.is_string())
        peer.retrieve =
            valueIn(ingest::kRetrieveMethodNames, value.get<std::string>(), "[peers] " + peer.name + ": retrieve");
    else if (field == "max_associations" && is_within(0, kMostAssociations))
        peer.max_associations = value;
    else if (field == "mb_per_s" && value.is_number() && value >= 0)
        peer.mb_per_s = value;
    else if (field == "tls" && value.is_boolean())
        peer.tls = value ? std::optional(tls) : std::nullopt;
    else if (field == "certificate_name" && value.is_string())
        peer.certificate_name = value;
    else if (!takeWebField(peer, field, value))
        wrong(peer.name, "'" + field + " = " + value.dump() + "' is not understood",
              "a peer has host, port, ae_title (1 to 16 characters), roles, retrieve, max_associations, mb_per_s, "
              "tls, certificate_name, url, user and password_file");
}

ingest::Peer peerFrom(const std::string& name, const nlohmann::json& about, const ingest::TlsOptions& tls)
{
    ingest::Peer peer;
    peer.name = name;
    peer.ae_title = name;
    for (const auto& [field, value] : about.items())
        takeField(peer, field, value, tls);
    if (peer.web) {
        while (peer.web->url.ends_with('/'))
            peer.web->url.pop_back();
        ingest::requireUsable(*peer.web, peer.tls.has_value());
        peer.stores = peer.stores && !peer.host.empty();  // nobody that could call
    }
    return peer;
}

}  // namespace

ingest::Peer requirePeer(const Config& config, const std::string& name, PeerUse use)
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
    ingest::Peer peer = peerFrom(name, peers.at(name), config.get<ingest::TlsOptions>());
    if (use == PeerUse::query && !peer.is_queried)
        wrong(name, "this peer is not to be asked", "add \"query\" to its roles");
    if (use == PeerUse::send && !peer.is_sent)
        wrong(name, "nothing is to be sent to this peer", "add \"send\" to its roles");
    return peer;
}

std::vector<ingest::Peer> configuredPeers(const Config& config)
{
    std::vector<ingest::Peer> peers;
    for (const auto& [name, about] : config.peers().items())
        peers.push_back(peerFrom(name, about, config.get<ingest::TlsOptions>()));
    return peers;
}

ingest::Receiver::Network networkOf(const Config& config)
{
    ingest::Receiver::Network network{configuredPeers(config), config.get<ingest::TlsOptions>()};
    std::erase_if(network.peers, [](const ingest::Peer& peer) { return peer.web && peer.host.empty(); });
    return network;
}

}  // namespace vicon::app
