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

bool CallerRules::Rule::allows(const std::string& other_title, const std::string& other_address) const
{
    return (title.empty() || title == other_title) && (address.empty() || address == other_address);
}

CallerRules::CallerRules(const ReceiverOptions& options, const std::vector<Peer>& peers)
{
    // A peer whose host is not known today is refused, and keeps nobody else waiting.
    for (const Peer& peer : peers)
        known_.push_back({peer, addressOf(peer.host)});
    std::istringstream entries(options.allow);
    for (std::string entry; std::getline(entries, entry, ',');)
        allow(withoutSpaces(entry));
    if (rules_.empty() && isThisMachineAlone(options.address))
        rules_.push_back({});
    else if (rules_.empty())
        allowPeers();
}

void CallerRules::allowPeers()
{
    if (known_.empty())
        throw Error(ErrorCode::wrong_use, "peers may call, and there are none", "receive.allow",
                    "add [peers] to the configuration, or set receive.allow to who may call");
    for (const Known& one : known_)
        if (!one.address.empty())
            rules_.push_back({one.peer.ae_title, one.address});
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
    if (at != std::string::npos && (rule.address = addressOf(withoutSpaces(entry.substr(at + 1)))).empty())
        throw Error(ErrorCode::wrong_use, "no such host", entry, "set receive.allow");
    if (rule.title.size() > kLongestTitle || (rule.title.empty() && rule.address.empty()))
        throw Error(ErrorCode::wrong_use, "who may call is TITLE, TITLE@HOST, @HOST, peers or anybody",
                    "'" + entry + "'", "set receive.allow");
    rules_.push_back(std::move(rule));
}

std::string CallerRules::whyRefused(const std::string& title, const std::string& address) const
{
    const auto allows = [&](const Rule& rule) { return rule.allows(title, address); };
    if (std::any_of(rules_.begin(), rules_.end(), allows))
        return "";
    const auto of_title = [&](const Rule& rule) { return rule.allows(title, rule.address); };
    return std::any_of(rules_.begin(), rules_.end(), of_title) ? "receive.allow names this title at another host"
                                                               : "receive.allow does not name it";
}

const Peer* CallerRules::peerOf(const std::string& title, const std::string& address) const
{
    const auto found = std::find_if(known_.begin(), known_.end(), [&](const Known& one) {
        return one.peer.ae_title == title && one.address == address;
    });
    return found == known_.end() ? nullptr : &found->peer;
}

std::vector<std::string> CallerRules::unreachablePeers() const
{
    std::vector<std::string> names;
    for (const Known& one : known_)
        if (one.address.empty())
            names.push_back(one.peer.name);
    return names;
}

}  // namespace vicon::ingest
