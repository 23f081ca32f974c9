#include "vicon/cases/comparisons.h"

#include <soci/soci.h>

#include <algorithm>

#include "case_rows.h"
#include "comparison_rows.h"
#include "json_fields.h"
#include "report_rows.h"
#include "this_person.h"
#include "vicon/cases/findings.h"
#include "vicon/cases/roles.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

using nlohmann::json;

namespace vicon {
namespace {

constexpr std::pair<const char*, std::string Comparison::*> kComparisonTexts[] = {
    {"finding", &Comparison::finding_id},
    {"report_uid", &Comparison::report_uid},
    {"report_class", &Comparison::report_class},
    {"report_series_uid", &Comparison::report_series_uid},
    {"study_uid", &Comparison::study_uid},
    {"maker", &Comparison::maker},
    {"prior_uid", &Comparison::prior_uid},
    {"prior_name", &Comparison::prior_name},
    {"prior_what", &Comparison::prior_what},
    {"prior_place", &Comparison::prior_place},
    {"person", &Comparison::person},
    {"at", &Comparison::at},
};

bool isOf(const Comparison& one, const std::string& finding_id, const std::string& report_uid,
          const std::string& prior_uid)
{
    return one.finding_id == finding_id && one.report_uid == report_uid && one.prior_uid == prior_uid;
}

bool sameComparison(const std::optional<Comparison>& a, const std::optional<Comparison>& b)
{
    return a && b ? toJson(*a) == toJson(*b) : !a && !b;
}

/// One thing then is one thing now.
void requireUnconfirmed(const std::vector<Comparison>& all, const Comparison& wanted)
{
    for (const Comparison& other : all) {
        const bool same_pair = isOf(other, wanted.finding_id, wanted.report_uid, wanted.prior_uid);
        if (!wanted.confirmed || !other.confirmed || same_pair || other.report_uid != wanted.report_uid)
            continue;
        if (other.finding_id == wanted.finding_id)
            throw Error(ErrorCode::bad_input, "the finding is said to be " + other.prior_name + " of this report",
                        wanted.finding_id, "take that back first");
        if (other.prior_uid == wanted.prior_uid)
            throw Error(ErrorCode::bad_input,
                        other.prior_name + " of this report is said to be finding " + other.finding_id,
                        wanted.finding_id, "take that back first");
    }
}

AuditEvent eventOf(const std::optional<Comparison>& after)
{
    if (!after)
        return AuditEvent::comparison_taken_back;
    return after->confirmed ? AuditEvent::comparison_confirmed : AuditEvent::comparison_rejected;
}

/// The diameter with its bounds, where the outlined one counts.
void takeBounds(MeasuredSize& taken, const std::optional<double>& outlined, const std::optional<double>& least,
                const std::optional<double>& most)
{
    if (taken.size_mm && outlined == taken.size_mm) {
        taken.least_mm = least;
        taken.most_mm = most;
    }
}

/// The outlined one with its bounds, where the finding says none.
template <class Sight>
void takeVolume(MeasuredSize& taken, const Sight& lead)
{
    if (taken.volume_ml)
        return;
    taken.volume_ml = lead.volume_ml;
    taken.volume_least_ml = lead.volume_least_ml;
    taken.volume_most_ml = lead.volume_most_ml;
}

}  // namespace

void putComparison(soci::session& sql, const std::string& case_id, const Comparison& one)
{
    const std::string content = toJson(one).dump();
    sql << "INSERT INTO comparisons (case_id, finding_id, report_uid, prior_uid, content)"
           " VALUES (:case, :finding, :report, :prior, :content)",
        soci::use(case_id), soci::use(one.finding_id), soci::use(one.report_uid), soci::use(one.prior_uid),
        soci::use(content);
}

json toJson(const Comparison& c)
{
    json out = {{"confirmed", c.confirmed}, {"before", toJson(c.before)}};
    for (const auto& [key, text] : kComparisonTexts)
        out[key] = c.*text;
    return out;
}

Comparison comparisonFromJson(const json& from)
{
    return understood("a comparison", [&] {
        Comparison c;
        c.confirmed = from.at("confirmed").get<bool>();
        c.before = measuredSizeFromJson(from.at("before"));
        for (const auto& [key, text] : kComparisonTexts)
            c.*text = from.at(key).get<std::string>();
        return c;
    });
}

Comparison comparisonWith(const std::string& finding_id, const PriorReport& report, const PriorFinding& prior,
                          const std::vector<PriorScan>& known)
{
    Comparison c{.finding_id = finding_id,
                 .report_uid = report.sop_uid,
                 .report_class = report.sop_class,
                 .report_series_uid = report.series_uid,
                 .study_uid = report.study.uid,
                 .maker = report.maker,
                 .prior_uid = prior.uid,
                 .prior_name = prior.name,
                 .prior_what = prior.kind ? nameOf(*prior.kind) : prior.what};
    c.before = {.size_mm = prior.size_mm, .from = prior.size_from, .volume_ml = prior.volume_ml, .date = report.when()};
    const PriorSight* lead = prior.lead();
    if (!lead)
        return c;
    c.prior_place = lead->part ? nameOf(*lead->part) : lead->site;
    takeBounds(c.before, lead->size_3d_mm, lead->size_least_mm, lead->size_most_mm);
    takeVolume(c.before, *lead);
    for (const std::vector<PriorScan>* scans : {&known, &report.scans})  // what the report says goes before
        for (const PriorScan& scan : *scans)
            if (scan.series_uid == lead->series_uid && !lead->series_uid.empty()) {
                if (!scan.kernel.empty())
                    c.before.kernel = scan.kernel;
                if (scan.slice_thickness_mm > 0)
                    c.before.slice_thickness_mm = scan.slice_thickness_mm;
            }
    return c;
}

std::vector<Comparison> comparisonsIn(soci::session& sql, const std::string& case_id)
{
    std::vector<Comparison> out;
    const soci::rowset<std::string> rows =
        (sql.prepare << "SELECT content FROM comparisons WHERE case_id = :c ORDER BY finding_id, report_uid, prior_uid",
         soci::use(case_id));
    for (const std::string& content : rows)
        out.push_back(comparisonFromJson(json::parse(content)));
    const auto number = [](const Comparison& c) { return Finding{.id = c.finding_id}.number(); };
    std::stable_sort(out.begin(), out.end(),
                     [&](const Comparison& a, const Comparison& b) { return number(a) < number(b); });
    return out;
}

std::vector<Comparison> comparisons(CaseStore& store, const std::string& case_id)
{
    return store.database().read([&](soci::session& sql) { return comparisonsIn(sql, case_id); });
}

std::optional<Comparison> findComparison(CaseStore& store, const std::string& case_id, const std::string& finding_id,
                                         const std::string& report_uid, const std::string& prior_uid)
{
    for (Comparison& one : comparisons(store, case_id))
        if (isOf(one, finding_id, report_uid, prior_uid))
            return std::move(one);
    return std::nullopt;
}

std::optional<Comparison> editComparison(CaseStore& store, const std::string& case_id,
                                         const std::optional<Comparison>& before, std::optional<Comparison> after)
{
    requireRole(Role::mark);
    const Comparison& key = after ? *after : before.value();
    requireFinding(store, case_id, key.finding_id);
    store.database().write([&](soci::session& sql) {
        requireOpenReport(sql, case_id);
        const auto stored = findComparison(store, case_id, key.finding_id, key.report_uid, key.prior_uid);
        if (!sameComparison(stored, before))
            throw Error(ErrorCode::bad_input, "another reader changed this comparison meanwhile; nothing was written",
                        key.finding_id, "look at it as it is now, and do it again if you still want it");
        if (after) {
            requireUnconfirmed(comparisonsIn(sql, case_id), *after);
            after->person = thisPerson();
            after->at = nowUtc();
        }
        sql << "DELETE FROM comparisons WHERE case_id = :c AND finding_id = :f AND report_uid = :r AND prior_uid = :p",
            soci::use(case_id), soci::use(key.finding_id), soci::use(key.report_uid), soci::use(key.prior_uid);
        if (after)
            putComparison(sql, case_id, *after);
        putAudit(sql, {eventOf(after), case_id, "", key.finding_id, before ? toJson(*before).dump() : "",
                       after ? toJson(*after).dump() : ""});
    });
    return after;
}

MeasuredSize measuredSizeOf(const Finding& finding, const FindingFacts& facts, const std::vector<ScanRecord>& scans,
                            const Study& study)
{
    MeasuredSize taken{.size_mm = facts.size_mm,
                       .from = facts.size_mm ? nameOf(facts.size_source) : "",
                       .volume_ml = finding.volume_ml,
                       .date = study.date};
    const FindingSight* lead = facts.lead();
    if (!lead)
        return taken;
    takeBounds(taken, lead->size_3d_mm, lead->size_least_mm, lead->size_most_mm);
    takeVolume(taken, *lead);
    for (const ScanRecord& scan : scans)
        if (scan.id == lead->scan_id) {
            taken.kernel = scan.series.kernel;
            taken.slice_thickness_mm = scan.series.slice_thickness_mm;
        }
    return taken;
}

}  // namespace vicon
