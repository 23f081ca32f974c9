#pragma once

#include <string>

#include "vicon/cases/audit_trail.h"
#include "vicon/cases/records.h"

namespace vicon::app {

/// A line of the audit trail as an audit message, in XML. Source: DICOM PS3.15 section A.5.
/// @param a_case what is known of the line's case; of one that was deleted its id, patient ID and study UID
/// @param machine where the audit trail lies
std::string atnaMessage(const NumberedAuditLine& line, const CaseRecord& a_case, const std::string& machine);

/// The message in a packet for syslog. Source: RFC 5424; facility and severity: DICOM PS3.15 section A.6.
std::string syslogPacket(const std::string& message, const std::string& at_utc, const std::string& machine);

}  // namespace vicon::app
