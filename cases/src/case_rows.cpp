#include "case_rows.h"

#include <algorithm>

#include "search_words.h"
#include "this_person.h"
#include "vicon/core/file.h"

using nlohmann::json;

namespace vicon {

CaseRecord caseFrom(const soci::row& row)
{
    CaseRecord c;
    c.id = row.get<std::string>("id");
    c.patient = {row.get<std::string>("patient_id"), row.get<std::string>("patient_name"),
                 row.get<std::string>("birth_date"), row.get<std::string>("sex")};
    c.study = json::parse(row.get<std::string>("study")).get<Study>();
    c.flags = json::parse(row.get<std::string>("flags")).get<std::vector<std::string>>();
    c.created = row.get<std::string>("created");
    return c;
}

ScanRecord scanFrom(const soci::row& row)
{
    ScanRecord s;
    s.id = row.get<std::string>("id");
    s.case_id = row.get<std::string>("case_id");
    s.series = json::parse(row.get<std::string>("series")).get<Series>();
    s.role = scanRoleFrom(row.get<std::string>("role"));
    s.ingest = json::parse(row.get<std::string>("ingest"));
    s.created = row.get<std::string>("created");
    return s;
}

InstanceRecord instanceFrom(const soci::row& row)
{
    return {row.get<std::string>("sop_uid"), row.get<std::string>("case_id"), row.get<std::string>("scan_id"),
            row.get<std::string>("sha256"), row.get<std::string>("file")};
}

StepRecord stepFrom(const soci::row& row)
{
    return {row.get<std::string>("step"),
            row.get<int>("version"),
            row.get<std::string>("digest"),
            json::parse(row.get<std::string>("parameters")),
            json::parse(row.get<std::string>("result")),
            row.get<double>("seconds"),
            row.get<std::string>("finished")};
}

std::string inList(const std::vector<CaseRecord>& cases)
{
    std::string list;
    for (const CaseRecord& c : cases)
        list += (list.empty() ? "('" : ", '") + c.id + "'";
    return list + ")";
}

void putCase(soci::session& sql, const CaseRecord& c)
{
    const std::string study = json(c.study).dump(), flags = json(c.flags).dump();
    sql << "INSERT INTO cases (id, study_uid, patient_id, patient_name, birth_date, sex, study, flags, created)"
           " VALUES (:id, :uid, :pid, :name, :birth, :sex, :study, :flags, :created)"
           " ON CONFLICT (id) DO UPDATE SET"  // what was not said before: the first word stands
           " patient_id = COALESCE(NULLIF(cases.patient_id, ''), excluded.patient_id),"
           " patient_name = COALESCE(NULLIF(cases.patient_name, ''), excluded.patient_name),"
           " birth_date = COALESCE(NULLIF(cases.birth_date, ''), excluded.birth_date),"
           " sex = COALESCE(NULLIF(cases.sex, ''), excluded.sex)",
        soci::use(c.id), soci::use(c.study.uid), soci::use(c.patient.id), soci::use(c.patient.name),
        soci::use(c.patient.birth_date), soci::use(c.patient.sex), soci::use(study), soci::use(flags),
        soci::use(c.created);
    putSearchWords(sql, c);
}

bool putFlag(soci::session& sql, const std::string& case_id, const std::string& line)
{
    std::string text;
    sql << "SELECT flags FROM cases WHERE id = :id", soci::use(case_id), soci::into(text);
    auto flags = json::parse(text).get<std::vector<std::string>>();
    if (std::ranges::find(flags, line) != flags.end())
        return false;
    flags.push_back(line);
    text = json(flags).dump();
    sql << "UPDATE cases SET flags = :flags WHERE id = :id", soci::use(text), soci::use(case_id);
    return true;
}

void putScan(soci::session& sql, const ScanRecord& s)
{
    const std::string series = json(s.series).dump(), ingest = s.ingest.dump(), role = nameOf(s.role);
    sql << "INSERT INTO scans (id, case_id, series_uid, series, role, ingest, created)"
           " VALUES (:id, :case, :uid, :series, :role, :ingest, :created)"
           " ON CONFLICT (case_id, id) DO UPDATE SET series = excluded.series, role = excluded.role,"
           " ingest = excluded.ingest",
        soci::use(s.id), soci::use(s.case_id), soci::use(s.series.uid), soci::use(series), soci::use(role),
        soci::use(ingest), soci::use(s.created);
}

void putInstances(soci::session& sql, const std::vector<InstanceRecord>& instances)
{
    InstanceRecord row;
    soci::statement insert =
        (sql.prepare << "INSERT INTO instances (sop_uid, case_id, scan_id, sha256, file)"
                        " VALUES (:sop, :case, :scan, :sha, :file) ON CONFLICT (sop_uid) DO UPDATE SET"
                        " scan_id = excluded.scan_id, sha256 = excluded.sha256, file = excluded.file",
         soci::use(row.sop_uid), soci::use(row.case_id), soci::use(row.scan_id), soci::use(row.sha256),
         soci::use(row.file));
    for (const InstanceRecord& instance : instances) {
        row = instance;
        insert.execute(true);
    }
}

void putAudit(soci::session& sql, AuditEvent event, const std::string& case_id, const std::string& scan_id,
              const std::string& detail)
{
    putAudit(sql, {event, case_id, scan_id, detail, "", ""});
}

void putAudit(soci::session& sql, const AuditedChange& change)
{
    const std::string now = nowUtc(), person = thisPerson(), event = nameOf(change.event);
    sql << "INSERT INTO audit (at, person, event, case_id, scan_id, detail, old_value, new_value)"
           " VALUES (:at, :person, :event, :case, :scan, :detail, :old, :new)",
        soci::use(now), soci::use(person), soci::use(event), soci::use(change.case_id), soci::use(change.scan_id),
        soci::use(change.subject), soci::use(change.before), soci::use(change.after);
}

int takeNumber(soci::session& sql, const std::string& name)
{
    int value = 0;
    sql << "INSERT INTO counters (name, value) VALUES (:name, 1)"
           " ON CONFLICT (name) DO UPDATE SET value = counters.value + 1 RETURNING value",
        soci::use(name), soci::into(value);
    return value;
}

}  // namespace vicon
