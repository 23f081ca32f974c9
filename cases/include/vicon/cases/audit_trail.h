#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"

namespace vicon {

/// A line of the audit trail, which the database only lets grow.
struct AuditLine {
    std::string at;      ///< UTC
    std::string person;  ///< local account; empty: written by a VICON that did not keep it
    std::string event;   ///< "finding changed", "report signed", ...
    std::string scan_id;
    std::string detail;
    nlohmann::json before, after;  ///< of what was changed; null where nothing was, or is, there
};
nlohmann::json toJson(const AuditLine& line);

/// Of one case, in the order in which it was written.
std::vector<AuditLine> auditTrail(CaseStore& store, const std::string& case_id);

}  // namespace vicon
