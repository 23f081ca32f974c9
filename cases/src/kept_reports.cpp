#include "vicon/cases/kept_reports.h"

#include <soci/soci.h>

#include "case_rows.h"

using nlohmann::json;

namespace vicon {
namespace {

KeptReport reportFrom(const soci::row& row)
{
    return {row.get<std::string>("sop_uid"),
            row.get<std::string>("sop_class"),
            row.get<std::string>("series_uid"),
            json::parse(row.get<std::string>("patient")).get<Patient>(),
            json::parse(row.get<std::string>("study")).get<Study>(),
            row.get<std::string>("sha256"),
            row.get<std::string>("file"),
            row.get<std::string>("created")};
}

}  // namespace

std::filesystem::path keptReportsFolder(const CaseStore& store)
{
    return store.folder() / "reports";
}

std::optional<KeptReport> findKeptReport(CaseStore& store, const std::string& sop_uid)
{
    const auto found = store.database().read([&](soci::session& sql) {
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT * FROM kept_reports WHERE sop_uid = :uid", soci::use(sop_uid));
        return collect(rows, reportFrom);
    });
    return found.empty() ? std::nullopt : std::optional(found.front());
}

std::vector<KeptReport> keptReportsOf(CaseStore& store, const std::string& patient_id)
{
    return store.database().read([&](soci::session& sql) {
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT * FROM kept_reports WHERE patient_id = :id ORDER BY study_date, sop_uid",
             soci::use(patient_id));
        return collect(rows, reportFrom);
    });
}

void keepReport(CaseStore& store, const KeptReport& report)
{
    const std::string patient = json(report.patient).dump(), study = json(report.study).dump();
    store.database().write([&](soci::session& sql) {
        sql << "INSERT INTO kept_reports (sop_uid, sop_class, series_uid, study_uid, study_date, patient_id, patient,"
               " study, sha256, file, created)"
               " VALUES (:sop, :class, :series, :uid, :date, :pid, :patient, :study, :sha, :file, :created)"
               " ON CONFLICT (sop_uid) DO UPDATE SET sop_class = excluded.sop_class, series_uid = excluded.series_uid,"
               " study_uid = excluded.study_uid, study_date = excluded.study_date, patient_id = excluded.patient_id,"
               " patient = excluded.patient, study = excluded.study, sha256 = excluded.sha256, file = excluded.file",
            soci::use(report.sop_uid), soci::use(report.sop_class), soci::use(report.series_uid),
            soci::use(report.study.uid), soci::use(report.study.date), soci::use(report.patient.id), soci::use(patient),
            soci::use(study), soci::use(report.sha256), soci::use(report.file), soci::use(report.created);
        putAudit(sql, AuditEvent::report_kept, "", "", report.sop_uid);
    });
}

}  // namespace vicon
