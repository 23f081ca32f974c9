// What a person must decide about a case.
#include <soci/soci.h>

#include "case_rows.h"
#include "vicon/cases/case_store.h"
#include "vicon/cases/roles.h"
#include "vicon/core/error.h"

using nlohmann::json;

namespace vicon {
void CaseStore::flag(const std::string& case_id, const std::string& line)
{
    database_.write([&](soci::session& sql) {
        requireCase(case_id);
        if (putFlag(sql, case_id, line))
            putAudit(sql, AuditEvent::flagged, case_id, "", line);
    });
}

void CaseStore::settleFlag(const std::string& case_id, const std::string& line)
{
    requireRole(Role::mark);
    database_.write([&](soci::session& sql) {
        auto flags = requireCase(case_id).flags;
        if (std::erase(flags, line) == 0)
            throw Error(ErrorCode::not_found, "the case has no such flag", case_id,
                        "'vicon show " + case_id + "' lists them");
        const std::string text = json(flags).dump();
        sql << "UPDATE cases SET flags = :flags WHERE id = :id", soci::use(text), soci::use(case_id);
        putAudit(sql, AuditEvent::flag_settled, case_id, "", line);
    });
}

bool CaseStore::wasFlagged(const std::string& case_id, const std::string& line)
{
    const std::string event = nameOf(AuditEvent::flagged);
    int count = 0;
    database_.read([&](soci::session& sql) {
        sql << "SELECT COUNT(*) FROM audit WHERE event = :event AND case_id = :c AND detail = :line", soci::use(event),
            soci::use(case_id), soci::use(line), soci::into(count);
    });
    return count > 0;
}

}  // namespace vicon
