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
    std::string event;   ///< name of an AuditEvent, or what another version of VICON wrote
    std::string scan_id;
    std::string detail;
    nlohmann::json before, after;  ///< of what was changed; null where nothing was, or is, there; before a deletion:
                                   ///< patient_id and study_uid
};
nlohmann::json toJson(const AuditLine& line);

/// A line of any case, by its place in the trail.
struct NumberedAuditLine {
    long long number = 0;  ///< grows
    std::string case_id;
    AuditLine line;
};
/// Those that follow a number, in order.
std::vector<NumberedAuditLine> auditAfter(CaseStore& store, long long number, int most);

/// The number of the last line that was told to others; 0: none was.
long long lastToldAudit(CaseStore& store);
void noteToldAudit(CaseStore& store, long long number);

/// Whose a line of the trail is: the case, or where it was deleted its id, patient ID and study UID as the trail has
/// them from then; of a case that was never there the id alone.
CaseRecord subjectOf(CaseStore& store, const std::string& case_id);

/// Of one case, in the order in which it was written.
std::vector<AuditLine> auditTrail(CaseStore& store, const std::string& case_id);

}  // namespace vicon
