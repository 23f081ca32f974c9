#include "caller_rules.h"

#include <algorithm>
#include <sstream>

#include "listening_socket.h"
#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

constexpr std::size_t kLongestTitle = 16;

std::string trimmed(const std::string& text)
{
    const std::size_t from = text.find_first_not_of(' ');
    return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(' ') - from + 1);
}

}  // namespace

CallerRules::CallerRules(const std::string& list)
{
    std::istringstream entries(list);
    for (std::string entry; std::getline(entries, entry, ',');) {
        entry = trimmed(entry);
        const std::size_t at = entry.find('@');
        Rule rule{trimmed(entry.substr(0, at)), {}};
        if (at != std::string::npos && (rule.address = addressOf(trimmed(entry.substr(at + 1)))).empty())
            throw Error(ErrorCode::wrong_use, "no such host", entry, "set receive.allow");
        if (rule.title.size() > kLongestTitle || (rule.title.empty() && rule.address.empty()))
            throw Error(ErrorCode::wrong_use, "who may call is TITLE, TITLE@HOST or @HOST", "'" + entry + "'",
                        "set receive.allow");
        rules_.push_back(std::move(rule));
    }
}

bool CallerRules::allows(const std::string& title, const std::string& address) const
{
    return rules_.empty() || std::any_of(rules_.begin(), rules_.end(), [&](const Rule& rule) {
               return (rule.title.empty() || rule.title == title) && (rule.address.empty() || rule.address == address);
           });
}

}  // namespace vicon::ingest
