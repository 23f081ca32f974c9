#include "priors.h"

#include <algorithm>
#include <set>

#include "vicon/cases/kept_reports.h"
#include "vicon/cases/report_content.h"
#include "vicon/cases/report_versions.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/ingest/patient_match.h"
#include "vicon/ingest/structured_report.h"
#include "vicon/report/prior_reading.h"

namespace vicon::app {
namespace {

/// The last signed report of another case.
std::optional<PriorReport> signedReport(CaseStore& store, const CaseRecord& record)
{
    const std::vector<ReportVersion> versions = reportVersions(store, record.id);
    const auto last = std::find_if(versions.rbegin(), versions.rend(), [](const auto& v) { return v.isSigned(); });
    if (last == versions.rend())
        return std::nullopt;
    return report::priorFrom(readCaseFromContent(nlohmann::json::parse(last->content)), *last);
}

std::vector<PriorReport> ownReports(CaseStore& store, const CaseRecord& record)
{
    std::vector<PriorReport> out;
    for (const CaseRecord& other : store.findCasesByPatient(record.patient.id))
        if (other.id != record.id)
            if (auto prior = signedReport(store, other))
                out.push_back(std::move(*prior));
    return out;
}

void addKept(CaseStore& store, const CaseRecord& record, PriorList& priors)
{
    for (const KeptReport& kept : keptReportsOf(store, record.patient.id)) {
        if (kept.study.uid == record.study.uid)
            continue;
        const auto file = keptReportsFolder(store) / kept.file;
        try {
            if (sha256OfFile(file) != kept.sha256)
                throw Error(ErrorCode::bad_input, "its file is not what was kept");
            PriorReport prior = report::priorFrom(ingest::readStructuredReport(file));
            if (const auto known = store.findCaseByStudy(kept.study.uid))
                prior.case_id = known->id;
            priors.reports.push_back(std::move(prior));
        } catch (const Error& e) {
            priors.left_out.push_back("report " + kept.sop_uid + ": " + e.what());
        }
    }
}

/// The same report may have come back from a PACS, and an amended one stands for those before it.
void dropReplaced(std::vector<PriorReport>& reports)
{
    std::set<std::string> replaced, seen;
    for (const PriorReport& report : reports)
        replaced.insert(report.replaces.begin(), report.replaces.end());
    std::erase_if(reports, [&](const PriorReport& report) {
        return replaced.contains(report.sop_uid) || !seen.insert(report.sop_uid).second;
    });
}

/// Of two signed versions in this store and elsewhere, the store's own last one counts.
void dropOlderVersions(std::vector<PriorReport>& reports, const std::vector<PriorReport>& own)
{
    std::erase_if(reports, [&](const PriorReport& report) {
        return std::any_of(own.begin(), own.end(), [&](const PriorReport& ours) {
            return ours.study.uid == report.study.uid && ours.maker == report.maker && ours.sop_uid != report.sop_uid &&
                   report.date <= ours.date;
        });
    });
}

}  // namespace

PriorList priorsOf(CaseStore& store, const std::string& case_id)
{
    const CaseRecord record = store.requireCase(case_id);
    PriorList priors;
    if (record.patient.id.empty()) {
        priors.left_out.emplace_back(
            "the study names no patient ID: no earlier report can be told to be this patient's");
        return priors;
    }
    const std::vector<PriorReport> own = ownReports(store, record);
    priors.reports = own;
    addKept(store, record, priors);
    dropReplaced(priors.reports);
    dropOlderVersions(priors.reports, own);
    std::erase_if(priors.reports, [&](const PriorReport& report) {
        if (!ingest::sameNameAndBirth(report.patient, record.patient)) {
            priors.left_out.push_back("report " + report.sop_uid +
                                      " has this patient ID, but another name or birth date");
            return true;
        }
        return !record.study.date.empty() && report.when() >= record.study.date;
    });
    std::stable_sort(priors.reports.begin(), priors.reports.end(),
                     [](const PriorReport& a, const PriorReport& b) { return a.when() > b.when(); });
    return priors;
}

std::vector<PriorScan> imagedScans(CaseStore& store, const PriorReport& report)
{
    std::vector<PriorScan> out;
    if (const auto known = store.findCaseByStudy(report.study.uid))
        for (const ScanRecord& scan : store.scans(known->id))
            out.push_back({scan.series.uid, positionName(scan.series.patient_position), scan.series.kernel,
                           scan.series.slice_thickness_mm});
    return out;
}

const PriorReport& requirePrior(const PriorList& priors, const std::string& sop_uid)
{
    for (std::size_t n = 0; n < priors.reports.size(); ++n)
        if (sop_uid == priors.reports[n].sop_uid || sop_uid == std::to_string(n + 1))
            return priors.reports[n];
    throw Error(ErrorCode::not_found, "no such earlier report", "'" + sop_uid + "'", "'vicon priors CASE' lists them");
}

}  // namespace vicon::app
