#include "atna_message.h"

#include <unistd.h>

#include <map>
#include <optional>
#include <pugixml.hpp>
#include <sstream>

#include "vicon/cases/audit_event.h"

namespace vicon::app {
namespace {

/// What kind of event a line tells of: DICOM PS3.15 A.5.3, by the codes of PS3.16 CID 400 and, where there is a type,
/// CID 401; its action (create, read, update, delete, execute) and outcome (0: success, 4: minor failure).
struct Kind {
    const char *code, *meaning, *action;
    const char *type = "", *type_meaning = "", *outcome = "0";
};

/// An event that another version of VICON wrote is told as a change of the case.
Kind kindOf(const std::string& event)
{
    static const Kind kTaken{"110104", "DICOM Instances Transferred", "C"},
        kSent{"110104", "DICOM Instances Transferred", "R"}, kSeen{"110103", "DICOM Instances Accessed", "R"},
        kDeleted{"110105", "DICOM Study Deleted", "D"}, kExported{"110106", "Export", "R"},
        kImported{"110107", "Import", "C"}, kChanged{"110110", "Patient Record", "U"};
    static const std::map<AuditEvent, Kind> kKinds{
        {AuditEvent::application_started, {"110100", "Application Activity", "E", "110120", "Application Start"}},
        {AuditEvent::application_stopped, {"110100", "Application Activity", "E", "110121", "Application Stop"}},
        {AuditEvent::peer_asked, {"110112", "Query", "E"}},
        {AuditEvent::caller_refused, {"110113", "Security Alert", "E", "110126", "Node Authentication", "4"}},
        {AuditEvent::account_refused, {"110113", "Security Alert", "E", "110132", "Use of Restricted Function", "4"}},
        {AuditEvent::files_imported, kImported},
        {AuditEvent::store_restored, kImported},
        {AuditEvent::store_backed_up, kExported},
        {AuditEvent::case_written_without_names, kExported},
        {AuditEvent::report_exported, kExported},
        {AuditEvent::picture_saved, kExported},
        {AuditEvent::imported, kTaken},
        {AuditEvent::object_queued, kSent},
        {AuditEvent::object_committed, kSent},
        {AuditEvent::object_unconfirmed, kSent},
        {AuditEvent::object_refused, kSent},
        {AuditEvent::object_queued_again, kSent},
        {AuditEvent::object_taken_out, kSent},
        {AuditEvent::case_opened, kSeen},
        {AuditEvent::case_deleted, kDeleted},
        {AuditEvent::scan_removed, kDeleted},
    };
    const std::optional<AuditEvent> known = auditEventFrom(event);
    const auto found = known ? kKinds.find(*known) : kKinds.end();
    return found == kKinds.end() ? kChanged : found->second;
}

void addCode(pugi::xml_node parent, const char* name, const char* code, const char* system, const char* meaning)
{
    pugi::xml_node node = parent.append_child(name);
    node.append_attribute("csd-code") = code;
    node.append_attribute("codeSystemName") = system;
    node.append_attribute("originalText") = meaning;
}

pugi::xml_node addObject(pugi::xml_node message, const std::string& id, const char* type, const char* role)
{
    pugi::xml_node object = message.append_child("ParticipantObjectIdentification");
    object.append_attribute("ParticipantObjectID") = id.c_str();
    object.append_attribute("ParticipantObjectTypeCode") = type;
    object.append_attribute("ParticipantObjectTypeCodeRole") = role;
    return object;
}

std::string base64(const std::string& text)
{
    static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t n = 0; n < text.size(); n += 3) {
        const std::size_t there = std::min<std::size_t>(3, text.size() - n);
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (k < there ? static_cast<unsigned char>(text[n + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            out += k <= there ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

void addEvent(pugi::xml_node message, const AuditLine& line, bool of_a_case)
{
    const Kind kind = kindOf(line.event);
    pugi::xml_node event = message.append_child("EventIdentification");
    event.append_attribute("EventActionCode") = kind.action;
    event.append_attribute("EventDateTime") = line.at.c_str();
    event.append_attribute("EventOutcomeIndicator") = kind.outcome;
    addCode(event, "EventID", kind.code, "DCM", kind.meaning);
    if (*kind.type)
        addCode(event, "EventTypeCode", kind.type, "DCM", kind.type_meaning);
    if (!of_a_case && !line.detail.empty())
        event.append_child("EventOutcomeDescription").text() = line.detail.c_str();
}

void addStudy(pugi::xml_node message, const NumberedAuditLine& line, const CaseRecord& a_case)
{
    const bool known = !a_case.study.uid.empty();
    pugi::xml_node study = addObject(message, known ? a_case.study.uid : line.case_id, "2", "3");  // a report
    addCode(study, "ParticipantObjectIDTypeCode", "110180", "DCM", "Study Instance UID");
    study.append_child("ParticipantObjectName").text() = line.case_id.c_str();
    for (const auto& [name, value] : {std::pair("event", line.line.event), std::pair("of", line.line.detail)}) {
        pugi::xml_node detail = study.append_child("ParticipantObjectDetail");
        detail.append_attribute("type") = name;
        detail.append_attribute("value") = base64(value).c_str();
    }
}

}  // namespace

std::string atnaMessage(const NumberedAuditLine& line, const CaseRecord& a_case, const std::string& machine)
{
    pugi::xml_document document;
    pugi::xml_node message = document.append_child("AuditMessage");
    addEvent(message, line.line, !line.case_id.empty());
    pugi::xml_node person = message.append_child("ActiveParticipant");
    person.append_attribute("UserID") = line.line.person.empty() ? "unknown" : line.line.person.c_str();
    person.append_attribute("UserIsRequestor") = "true";
    person.append_attribute("NetworkAccessPointID") = machine.c_str();
    person.append_attribute("NetworkAccessPointTypeCode") = "1";  // a machine's name
    pugi::xml_node source = message.append_child("AuditSourceIdentification");
    source.append_attribute("AuditSourceID") = ("VICON@" + machine).c_str();
    if (!line.case_id.empty())
        addStudy(message, line, a_case);
    if (!a_case.patient.id.empty()) {
        pugi::xml_node patient = addObject(message, a_case.patient.id, "1", "1");
        addCode(patient, "ParticipantObjectIDTypeCode", "2", "RFC-3881", "Patient Number");
    }
    std::ostringstream out;
    document.save(out, "", pugi::format_raw, pugi::encoding_utf8);
    return out.str();
}

std::string syslogPacket(const std::string& message, const std::string& at_utc, const std::string& machine)
{
    constexpr int kAuthorization = 10, kNotice = 5, kLevels = 8;
    return "<" + std::to_string(kAuthorization * kLevels + kNotice) + ">1 " + at_utc + " " + machine + " VICON " +
           std::to_string(::getpid()) + " DICOM+RFC3881 - \xEF\xBB\xBF" + message;
}

}  // namespace vicon::app
