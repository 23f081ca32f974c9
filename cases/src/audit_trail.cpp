#include "vicon/cases/audit_trail.h"

#include <soci/soci.h>

#include "case_rows.h"
#include "deleted_case.h"

using nlohmann::json;

namespace vicon {
namespace {

AuditLine lineFrom(const soci::row& row)
{
    const auto value = [](const std::string& text) {
        return text.empty() ? json() : json::parse(text, nullptr, false);
    };
    return {row.get<std::string>("at"),
            row.get<std::string>("person"),
            row.get<std::string>("event"),
            row.get<std::string>("scan_id"),
            row.get<std::string>("detail"),
            value(row.get<std::string>("old_value")),
            value(row.get<std::string>("new_value"))};
}

/// The databases call this column's type differently.
long long numberIn(const soci::row& row)
{
    return row.get_properties("number").get_data_type() == soci::dt_integer ? row.get<int>("number")
                                                                            : row.get<long long>("number");
}

constexpr const char* kTold = "audit told";

}  // namespace

json toJson(const AuditLine& line)
{
    return {{"at", line.at},         {"person", line.person}, {"event", line.event}, {"scan", line.scan_id},
            {"detail", line.detail}, {"before", line.before}, {"after", line.after}};
}

std::vector<AuditLine> auditTrail(CaseStore& store, const std::string& case_id)
{
    return store.database().read([&](soci::session& sql) {
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT * FROM audit WHERE case_id = :c ORDER BY rowid", soci::use(case_id));
        return collect(rows, lineFrom);
    });
}

CaseRecord subjectOf(CaseStore& store, const std::string& case_id)
{
    if (auto known = store.findCase(case_id))
        return *known;
    CaseRecord gone{.id = case_id};
    for (const AuditLine& line : auditTrail(store, case_id))
        if (line.event == nameOf(AuditEvent::case_deleted) && line.before.is_object()) {
            gone.patient.id = line.before.value(kPatientIdKey, "");
            gone.study.uid = line.before.value(kStudyUidKey, "");
        }
    return gone;
}

std::vector<NumberedAuditLine> auditAfter(CaseStore& store, long long number, int most)
{
    return store.database().read([&](soci::session& sql) {
        std::vector<NumberedAuditLine> out;
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT rowid AS number, audit.* FROM audit WHERE rowid > :n ORDER BY rowid LIMIT :most",
             soci::use(number), soci::use(most));
        for (const soci::row& row : rows)
            out.push_back({numberIn(row), row.get<std::string>("case_id"), lineFrom(row)});
        return out;
    });
}

long long lastToldAudit(CaseStore& store)
{
    const std::string name = kTold;
    long long number = 0;
    store.database().read([&](soci::session& sql) {
        sql << "SELECT COALESCE(MAX(value), 0) FROM counters WHERE name = :n", soci::use(name), soci::into(number);
    });
    return number;
}

void noteToldAudit(CaseStore& store, long long number)
{
    const std::string name = kTold;
    store.database().write([&](soci::session& sql) {
        sql << "INSERT INTO counters (name, value) VALUES (:n, :v)"
               " ON CONFLICT (name) DO UPDATE SET value = excluded.value",
            soci::use(name), soci::use(number);
    });
}

}  // namespace vicon
