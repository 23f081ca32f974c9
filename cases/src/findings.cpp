#include "vicon/cases/findings.h"

#include <soci/soci.h>

#include <algorithm>

#include "case_rows.h"
#include "report_rows.h"
#include "vicon/cases/roles.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

using nlohmann::json;

namespace vicon {
namespace {

/// When a finding was written does not make it another one.
bool sameFinding(const std::optional<Finding>& a, const std::optional<Finding>& b)
{
    if (!a || !b)
        return !a && !b;
    json x = toJson(*a), y = toJson(*b);
    for (json* finding : {&x, &y})
        finding->erase("changed");
    return x == y;
}

std::vector<Finding> allFindings(soci::session& sql, const std::string& case_id)
{
    std::vector<Finding> out;
    const soci::rowset<std::string> rows =
        (sql.prepare << "SELECT content FROM findings WHERE case_id = :c", soci::use(case_id));
    for (const std::string& content : rows)
        out.push_back(findingFromJson(json::parse(content)));
    std::sort(out.begin(), out.end(), [](const Finding& a, const Finding& b) { return a.number() < b.number(); });
    return out;
}

std::optional<Finding> findFinding(soci::session& sql, const std::string& case_id, const std::string& id)
{
    for (Finding& finding : allFindings(sql, case_id))
        if (finding.id == id)
            return std::move(finding);
    return std::nullopt;
}

/// A marker shows one thing. A finding may name markers that were deleted, but takes no new one that is not there.
void requireMarkers(CaseStore& store, const std::string& case_id, const FindingEdit& edit)
{
    for (const std::string& marker : edit.after->markers) {
        const bool had = edit.before && std::count(edit.before->markers.begin(), edit.before->markers.end(), marker);
        if (!had)
            store.requireMarker(case_id, marker);
        for (const Finding& other : findings(store, case_id))
            if (other.id != edit.after->id && std::count(other.markers.begin(), other.markers.end(), marker))
                throw Error(ErrorCode::bad_input, "marker " + marker + " belongs to finding " + other.id + " already",
                            case_id, "take it out there first, or add its other markers to that finding");
    }
}

void putFinding(soci::session& sql, const std::string& case_id, FindingEdit& edit)
{
    Finding& finding = *edit.after;
    finding.changed = nowUtc();
    if (finding.created.empty())
        finding.created = finding.changed;
    if (finding.id.empty())
        (finding.id = "f") += std::to_string(takeNumber(sql, "finding " + case_id));
    const std::string content = toJson(finding).dump();
    sql << "INSERT INTO findings (case_id, id, content) VALUES (:case, :id, :content)"
           " ON CONFLICT (case_id, id) DO UPDATE SET content = excluded.content",
        soci::use(case_id), soci::use(finding.id), soci::use(content);
    putAudit(sql, {edit.before ? AuditEvent::finding_changed : AuditEvent::finding_added, case_id, "", finding.id,
                   edit.before ? toJson(*edit.before).dump() : "", content});
}

void requireCaseInStore(CaseStore& store, const std::string& case_id)
{
    if (!store.findCase(case_id))
        throw Error(ErrorCode::not_found, "no such case", "'" + case_id + "'", "'vicon cases' lists them");
}

std::string storedAssessment(soci::session& sql, const std::string& case_id)
{
    std::string content;
    soci::indicator there = soci::i_null;
    sql << "SELECT content FROM assessments WHERE case_id = :c", soci::use(case_id), soci::into(content, there);
    return sql.got_data() ? content : "";
}

}  // namespace

std::vector<Finding> findings(CaseStore& store, const std::string& case_id)
{
    return store.database().read([&](soci::session& sql) { return allFindings(sql, case_id); });
}

Finding requireFinding(CaseStore& store, const std::string& case_id, const std::string& finding_id)
{
    for (const std::string& id : {finding_id, "f" + finding_id})
        if (auto found = store.database().read([&](soci::session& sql) { return findFinding(sql, case_id, id); }))
            return *found;
    throw Error(ErrorCode::not_found, "no finding '" + finding_id + "'", case_id,
                "'vicon finding " + case_id + "' lists them");
}

std::vector<FindingEdit> editFindings(CaseStore& store, const std::string& case_id, std::vector<FindingEdit> edits)
{
    requireRole(Role::mark);
    store.database().write([&](soci::session& sql) {
        requireCaseInStore(store, case_id);
        requireOpenReport(sql, case_id);
        for (FindingEdit& edit : edits) {
            const std::string id = edit.before ? edit.before->id : edit.after ? edit.after->id : "";
            if (!id.empty() && !sameFinding(findFinding(sql, case_id, id), edit.before))
                throw Error(ErrorCode::bad_input, "another reader changed this finding meanwhile; nothing was written",
                            id, "look at it as it is now, and do it again if you still want it");
            if (edit.after) {
                requireMarkers(store, case_id, edit);
                putFinding(sql, case_id, edit);
            } else if (edit.before) {
                sql << "DELETE FROM findings WHERE case_id = :c AND id = :id", soci::use(case_id), soci::use(id);
                putAudit(sql, {AuditEvent::finding_removed, case_id, "", id, toJson(*edit.before).dump(), ""});
            }
        }
    });
    return edits;
}

std::vector<std::string> withPartners(CaseStore& store, const std::string& case_id,
                                      const std::vector<std::string>& marker_ids)
{
    std::vector<std::string> out;
    const auto add = [&](const std::string& id) {
        if (!id.empty() && std::find(out.begin(), out.end(), id) == out.end())
            out.push_back(id);
    };
    for (const std::string& id : marker_ids) {
        const Marker marker = store.requireMarker(case_id, id);
        add(marker.id);
        for (const std::string& partner : marker.partners)
            add(partner);
    }
    return out;
}

Assessment assessmentOf(CaseStore& store, const std::string& case_id)
{
    const std::string content =
        store.database().read([&](soci::session& sql) { return storedAssessment(sql, case_id); });
    return content.empty() ? Assessment{} : assessmentFromJson(json::parse(content));
}

void saveAssessment(CaseStore& store, const std::string& case_id, const Assessment& before, const Assessment& after)
{
    requireRole(Role::mark);
    const std::string seen = toJson(before).dump(), content = toJson(after).dump();
    store.database().write([&](soci::session& sql) {
        requireCaseInStore(store, case_id);
        requireOpenReport(sql, case_id);
        const std::string stored = storedAssessment(sql, case_id);
        if ((stored.empty() ? toJson(Assessment{}).dump() : stored) != seen)
            throw Error(ErrorCode::bad_input, "another reader changed the assessment meanwhile; nothing was written",
                        case_id, "look at it as it is now, and do it again if you still want it");
        sql << "INSERT INTO assessments (case_id, content) VALUES (:case, :content)"
               " ON CONFLICT (case_id) DO UPDATE SET content = excluded.content",
            soci::use(case_id), soci::use(content);
        putAudit(sql, {AuditEvent::assessment_changed, case_id, "", "", stored, content});
    });
}

}  // namespace vicon
