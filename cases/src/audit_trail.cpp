#include "vicon/cases/audit_trail.h"

#include <soci/soci.h>

using nlohmann::json;

namespace vicon {

json toJson(const AuditLine& line)
{
    return {{"at", line.at},         {"person", line.person}, {"event", line.event}, {"scan", line.scan_id},
            {"detail", line.detail}, {"before", line.before}, {"after", line.after}};
}

std::vector<AuditLine> auditTrail(CaseStore& store, const std::string& case_id)
{
    const auto value = [](const std::string& text) {
        return text.empty() ? json() : json::parse(text, nullptr, false);
    };
    std::vector<AuditLine> out;
    const soci::rowset<soci::row> rows =
        (store.database().session().prepare << "SELECT * FROM audit WHERE case_id = :c ORDER BY rowid",
         soci::use(case_id));
    for (const soci::row& row : rows)
        out.push_back({row.get<std::string>("at"), row.get<std::string>("person"), row.get<std::string>("event"),
                       row.get<std::string>("scan_id"), row.get<std::string>("detail"),
                       value(row.get<std::string>("old_value")), value(row.get<std::string>("new_value"))});
    return out;
}

}  // namespace vicon
