#include "vicon/cases/audit_event.h"

#include <algorithm>

#include "vicon/core/enum_names.h"

namespace vicon {
namespace {

// What stands in the trails of stores: none is ever called otherwise.
constexpr EnumNames<AuditEvent, 49> kEventNames{{
    {AuditEvent::imported, "imported"},
    {AuditEvent::scan_removed, "scan removed"},
    {AuditEvent::scan_read, "scan read"},
    {AuditEvent::case_opened, "case opened"},
    {AuditEvent::case_deleted, "case deleted"},
    {AuditEvent::case_written_without_names, "case written without names"},
    {AuditEvent::quarantined, "quarantined"},
    {AuditEvent::flagged, "flagged"},
    {AuditEvent::flag_settled, "flag settled"},
    {AuditEvent::order_taken, "order taken"},
    {AuditEvent::organ_named, "organ"},
    {AuditEvent::corrections_changed, "corrections"},
    {AuditEvent::lumen_given, "lumen given"},
    {AuditEvent::lumen_taken_back, "lumen taken back"},
    {AuditEvent::bridge_confirmed, "bridge confirmed"},
    {AuditEvent::bridge_rejected, "bridge rejected"},
    {AuditEvent::bridge_unjudged, "bridge unjudged"},
    {AuditEvent::marker_saved, "marker saved"},
    {AuditEvent::marker_removed, "marker removed"},
    {AuditEvent::finding_added, "finding added"},
    {AuditEvent::finding_changed, "finding changed"},
    {AuditEvent::finding_removed, "finding removed"},
    {AuditEvent::assessment_changed, "assessment changed"},
    {AuditEvent::comparison_confirmed, "comparison confirmed"},
    {AuditEvent::comparison_rejected, "comparison rejected"},
    {AuditEvent::comparison_taken_back, "comparison taken back"},
    {AuditEvent::picture_saved, "picture saved"},
    {AuditEvent::report_written, "report written"},
    {AuditEvent::report_preliminary, "report preliminary"},
    {AuditEvent::report_signed, "report signed"},
    {AuditEvent::report_amended, "report amended"},
    {AuditEvent::report_exported, "report exported"},
    {AuditEvent::report_kept, "report kept"},
    {AuditEvent::amendment_begun, "amendment begun"},
    {AuditEvent::amendment_cancelled, "amendment cancelled"},
    {AuditEvent::object_queued, "queued for a peer"},
    {AuditEvent::object_committed, "object committed"},
    {AuditEvent::object_unconfirmed, "object unconfirmed"},
    {AuditEvent::object_refused, "object refused"},
    {AuditEvent::object_queued_again, "object to be sent again"},
    {AuditEvent::object_taken_out, "object taken out of the outbox"},
    {AuditEvent::account_refused, "account refused"},
    {AuditEvent::application_started, "application started"},
    {AuditEvent::application_stopped, "application stopped"},
    {AuditEvent::files_imported, "files imported"},
    {AuditEvent::store_backed_up, "store backed up"},
    {AuditEvent::store_restored, "store restored"},
    {AuditEvent::peer_asked, "peer asked"},
    {AuditEvent::caller_refused, "caller refused"},
}};

}  // namespace

std::string nameOf(AuditEvent event)
{
    return nameIn(kEventNames, event);
}

std::optional<AuditEvent> auditEventFrom(const std::string& name)
{
    const auto found =
        std::find_if(kEventNames.begin(), kEventNames.end(), [&](const auto& row) { return row.second == name; });
    return found == kEventNames.end() ? std::nullopt : std::optional(found->first);
}

std::vector<std::string> auditEventNames()
{
    return namesOf(kEventNames);
}

}  // namespace vicon
