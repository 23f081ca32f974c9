#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vicon {

/// What a line of the audit trail tells of.
enum class AuditEvent {
    imported,
    scan_removed,
    scan_read,
    case_opened,
    case_deleted,
    case_written_without_names,
    quarantined,
    flagged,
    flag_settled,
    order_taken,
    organ_named,
    corrections_changed,
    lumen_given,
    lumen_taken_back,
    bridge_confirmed,
    bridge_rejected,
    bridge_unjudged,
    marker_saved,
    marker_removed,
    finding_added,
    finding_changed,
    finding_removed,
    assessment_changed,
    comparison_confirmed,
    comparison_rejected,
    comparison_taken_back,
    picture_saved,
    report_written,  ///< a draft
    report_preliminary,
    report_signed,
    report_amended,
    report_exported,
    report_kept,  ///< of another system
    amendment_begun,
    amendment_cancelled,
    object_queued,
    object_committed,
    object_unconfirmed,
    object_refused,
    object_queued_again,
    object_taken_out,
    account_refused,
    // Of no case:
    application_started,
    application_stopped,
    files_imported,
    store_backed_up,
    store_restored,
    peer_asked,
    caller_refused,
};
/// As the trail has it and people read it: "finding changed", "report signed", ...
std::string nameOf(AuditEvent event);
/// Nothing for another name: a trail may hold what another version of VICON wrote.
std::optional<AuditEvent> auditEventFrom(const std::string& name);
/// All of them, in order.
std::vector<std::string> auditEventNames();

}  // namespace vicon
