#pragma once

#include <functional>
#include <string>
#include <vector>

#include "vicon/core/options.h"

namespace vicon {

/// What an account may be allowed to do. Signing is apart: see SigningOptions.
enum class Role {
    read,     ///< look at cases, and write draft reports
    mark,     ///< add to a case: markers, findings, categories, corrections
    operate,  ///< receive, fetch, send, work on the queue, delete, back up
};

struct RoleOptions {
    std::vector<std::string> read, mark, operate;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("roles.read", read, "", "Local accounts, or @GROUP, that may look at cases; none: all.");
        v("roles.mark", mark, "", "Those that may mark, correct and assess; none: all.");
        v("roles.operate", operate, "",
          "Those that may receive, fetch, send, work, delete and back up, beside the services' account vicon; none: "
          "all.");
    }
};

/// Whether the account is listed, by its own name or through one of its groups ("@GROUP").
bool isAmong(const std::string& account, const std::vector<std::string>& entries);

/// Whether an account has a role by these rules. The services' own account may always operate: without it nothing would
/// be received, worked on or purged.
bool hasRole(const std::string& account, Role role, const RoleOptions& options);

/// The rules that requireRole() follows from now on. Until then everybody may do everything.
/// @param on_refusal told what an account may not, before requireRole() throws
void setRoles(const RoleOptions& options, std::function<void(const std::string& what)> on_refusal = {});
/// Throws Error{bad_input} unless the account that runs this program has the role.
void requireRole(Role role);

}  // namespace vicon
