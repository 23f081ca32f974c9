#pragma once

#include <functional>
#include <string>
#include <vector>

#include "vicon/core/options.h"

namespace vicon {

/// What an account may do; who may sign is SigningOptions'.
enum class Role {
    read,     ///< look at cases, and write reports that are drafts
    mark,     ///< say something of a case: markers, findings, categories, corrections
    operate,  ///< receive, fetch, send, work on the queue, delete, back up
};

struct RoleOptions {
    std::vector<std::string> read, mark, operate;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("roles.read", read, "", "Local accounts, or @GROUP, that may look at cases; none: all.");
        v("roles.mark", mark, "", "Those that may mark, correct and assess; none: all.");
        v("roles.operate", operate, "", "Those that may receive, fetch, send, work, delete and back up; none: all.");
    }
};

/// Whether an account is one of these, or in a group of theirs ("@GROUP").
bool isAmong(const std::string& account, const std::vector<std::string>& entries);

/// By these rules requireRole() goes from now on; before, everybody may do everything.
/// @param on_refusal told what an account may not, before requireRole() throws
void setRoles(const RoleOptions& options, std::function<void(const std::string& what)> on_refusal = {});
/// Throws Error{bad_input} where whoever runs this may not.
void requireRole(Role role);

}  // namespace vicon
