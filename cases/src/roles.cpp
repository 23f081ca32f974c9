#include "vicon/cases/roles.h"

#include <grp.h>
#include <pwd.h>

#include <algorithm>
#include <mutex>

#include "this_person.h"
#include "vicon/core/error.h"

namespace vicon {
namespace {

/// That of the units, the image and the manifest in deploy/. Nobody can log in as it.
constexpr const char* kServiceAccount = "vicon";

struct Rules {
    std::mutex mutex;
    RoleOptions options;
    std::function<void(const std::string& what)> on_refusal;
};

Rules& rules()
{
    static Rules one;
    return one;
}

std::vector<gid_t> groupsOf(const std::string& account)
{
    const passwd* entry = ::getpwnam(account.c_str());
    if (!entry)
        return {};
    int count = 0;
    ::getgrouplist(account.c_str(), entry->pw_gid, nullptr, &count);
    std::vector<gid_t> groups(std::size_t(std::max(count, 1)));
    if (::getgrouplist(account.c_str(), entry->pw_gid, groups.data(), &count) < 0)
        return {};
    groups.resize(std::size_t(count));
    return groups;
}

bool isMember(const std::string& account, const std::string& group)
{
    const ::group* entry = ::getgrnam(group.c_str());
    if (!entry)
        return false;
    const gid_t wanted = entry->gr_gid;
    const auto groups = groupsOf(account);
    return std::find(groups.begin(), groups.end(), wanted) != groups.end();
}

struct Rule {
    const char *name, *what;
    const std::vector<std::string>& accounts;
};

Rule ruleFor(Role role, const RoleOptions& options)
{
    switch (role) {
        case Role::read:
            return {"read", "look at cases", options.read};
        case Role::mark:
            return {"mark", "mark or assess", options.mark};
        case Role::operate:
            break;
    }
    return {"operate", "do this", options.operate};
}

}  // namespace

bool isAmong(const std::string& account, const std::vector<std::string>& entries)
{
    return std::any_of(entries.begin(), entries.end(), [&](const std::string& entry) {
        return entry == account || (entry.starts_with('@') && isMember(account, entry.substr(1)));
    });
}

bool hasRole(const std::string& account, Role role, const RoleOptions& options)
{
    const std::vector<std::string>& accounts = ruleFor(role, options).accounts;
    return accounts.empty() || isAmong(account, accounts) || (role == Role::operate && account == kServiceAccount);
}

void setRoles(const RoleOptions& options, std::function<void(const std::string& what)> on_refusal)
{
    const std::lock_guard lock(rules().mutex);
    rules().options = options;
    rules().on_refusal = std::move(on_refusal);
}

void requireRole(Role role)
{
    std::unique_lock lock(rules().mutex);
    const Rule rule = ruleFor(role, rules().options);
    const std::string person = thisPerson();
    if (hasRole(person, role, rules().options))
        return;
    const auto on_refusal = rules().on_refusal;
    lock.unlock();
    if (on_refusal)
        on_refusal(std::string("may not ") + rule.what);
    throw Error(ErrorCode::bad_input, std::string("this account may not ") + rule.what, "'" + person + "'",
                std::string("who runs VICON here names those who may in the configuration: [roles] ") + rule.name);
}

}  // namespace vicon
