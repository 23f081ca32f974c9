#include "caller_rules.h"

#include <algorithm>
#include <sstream>

#include "listening_socket.h"
#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

constexpr std::size_t kLongestTitle = 16;

std::string withoutSpaces(const std::string& text)
{
    const std::size_t from = text.find_first_not_of(' ');
    return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(' ') - from + 1);
}

bool isThisMachineAlone(const std::string& address)
{
    return addressOf(address).starts_with("127.");
}

}  // namespace

CallerRules::CallerRules(const ReceiverOptions& options, const std::vector<Peer>& peers) : peers_(peers)
{
    std::istringstream entries(options.allow);
    for (std::string entry; std::getline(entries, entry, ',');)
        allow(withoutSpaces(entry));
    if (rules_.empty() && isThisMachineAlone(options.address))
        rules_.push_back({});
    else if (rules_.empty())
        allowPeers();
    addresses_ = std::make_unique<HostAddresses>(hosts(), addressesOf, HostAddresses::Intervals{});
}

std::vector<std::string> CallerRules::hosts() const
{
    std::vector<std::string> all;
    for (const Peer& peer : peers_)
        all.push_back(peer.host);
    for (const Rule& rule : rules_)
        if (!rule.host.empty())
            all.push_back(rule.host);
    return all;
}

bool CallerRules::allows(const Rule& rule, const std::string& title, const std::string& address) const
{
    return (rule.title.empty() || rule.title == title) && (rule.host.empty() || addresses_->has(rule.host, address));
}

void CallerRules::allowPeers()
{
    if (peers_.empty())
        throw Error(ErrorCode::wrong_use, "peers may call, and there are none", "receive.allow",
                    "add [peers] to the configuration, or set receive.allow to who may call");
    for (const Peer& peer : peers_)
        if (!peer.host.empty())
            rules_.push_back({peer.ae_title, peer.host});
}

void CallerRules::allow(const std::string& entry)
{
    if (entry == "peers")
        return allowPeers();
    if (entry == "anybody") {
        rules_.push_back({});
        return;
    }
    const std::size_t at = entry.find('@');
    Rule rule{withoutSpaces(entry.substr(0, at)), {}};
    if (at != std::string::npos)
        rule.host = withoutSpaces(entry.substr(at + 1));
    const bool no_host = at != std::string::npos && rule.host.empty();
    if (rule.title.size() > kLongestTitle || (rule.title.empty() && rule.host.empty()) || no_host)
        throw Error(ErrorCode::wrong_use, "who may call is TITLE, TITLE@HOST, @HOST, peers or anybody",
                    "'" + entry + "'", "set receive.allow");
    rules_.push_back(std::move(rule));
}

std::string CallerRules::whyRefused(const std::string& title, const std::string& address) const
{
    if (std::any_of(rules_.begin(), rules_.end(), [&](const Rule& rule) { return allows(rule, title, address); }))
        return "";
    const auto of_title = [&](const Rule& rule) { return !rule.title.empty() && rule.title == title; };
    return std::any_of(rules_.begin(), rules_.end(), of_title) ? "receive.allow names this title at another host"
                                                               : "receive.allow does not name it";
}

const Peer* CallerRules::peerOf(const std::string& title, const std::string& address) const
{
    const auto found = std::find_if(peers_.begin(), peers_.end(), [&](const Peer& peer) {
        return peer.ae_title == title && addresses_->has(peer.host, address);
    });
    return found == peers_.end() ? nullptr : &*found;
}

std::vector<std::string> CallerRules::news()
{
    std::vector<std::string> lines;
    for (const std::string& host : hosts()) {
        const bool is_known = addresses_->isKnown(host);
        if (is_known && without_.erase(host) > 0)
            lines.push_back("host '" + host + "' has an address now");
        else if (!is_known && without_.insert(host).second)
            lines.push_back("host '" + host + "' has no address: who calls from it is refused until it has one");
    }
    return lines;
}

}  // namespace vicon::ingest
