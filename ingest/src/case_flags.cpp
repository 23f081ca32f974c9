#include "case_flags.h"

#include <algorithm>

#include "signed_version.h"
#include "vicon/ingest/patient_match.h"

namespace vicon::ingest {
namespace {

/// A flag that a person took away does not come back.
bool isNewFlag(const ImportContext& context, const CaseRecord& of_case, const std::string& line)
{
    return std::find(of_case.flags.begin(), of_case.flags.end(), line) == of_case.flags.end() &&
           !context.store.wasFlagged(of_case.id, line);
}

void reportFlag(const ImportContext& context, const std::string& case_id, const std::string& line)
{
    context.reporter.line({ImportLine::Kind::flagged, case_id, line + "; a person must decide", case_id, {}});
}

/// A case is flagged once for its patient ID, however many others have it.
void flagIdOnce(const ImportContext& context, const CaseRecord& flagged, const std::string& other)
{
    const std::string begin = "the patient ID is also that of case ";
    const std::string line = begin + other + ", with another name or birth date";
    if (std::any_of(flagged.flags.begin(), flagged.flags.end(),
                    [&](const std::string& flag) { return flag.starts_with(begin); }) ||
        !isNewFlag(context, flagged, line))
        return;
    context.store.flag(flagged.id, line);
    reportFlag(context, flagged.id, line);
}

}  // namespace

std::string flagForLateScan(const ImportContext& context, const StoredStudy& stored,
                            const std::vector<AssembledScan>& scans, const AssembledScan& late)
{
    if (stored.with_reader_input.empty())
        return {};
    const ScanRecord& record = late.record;
    const auto same_series = std::find_if(scans.begin(), scans.end(), [&](const AssembledScan& other) {
        return other.fixed && other.record.series.uid == record.series.uid;
    });
    const bool grows = same_series != scans.end();
    const std::string beside = grows ? same_series->record.id : record.ingest.value("reconstruction_of", "");
    const std::string series = (grows ? "images of series " : "series ") + std::to_string(record.series.number);
    const int version = signedVersion(context.store, stored.record.id);
    const std::string after =
        version > 0
            ? "its report was signed (version " + std::to_string(version) + ")"
            : (stored.with_reader_input.contains(beside) ? "scan " + beside : "this case") + " was marked or reported";
    const std::string line = series + " came after " + after + ": " +
                             (stored.isFixed(beside) ? "beside scan " + beside + " as scan " : "scan ") + record.id;
    return isNewFlag(context, stored.record, line) ? line : "";
}

void tellFlag(const ImportContext& context, const std::string& case_id, const std::string& line)
{
    context.store.audit(AuditEvent::flagged, case_id, {}, line);
    reportFlag(context, case_id, line);
}

void flagSharedId(const ImportContext& context, const CaseRecord& of_case)
{
    if (of_case.patient.id.empty())
        return;
    const auto self = context.store.findCase(of_case.id);
    if (!self)
        return;
    const std::vector<CaseRecord> namesakes = context.store.findCasesByPatient(of_case.patient.id);
    const auto other = std::find_if(namesakes.begin(), namesakes.end(), [&](const CaseRecord& c) {
        return c.id != of_case.id && !sameNameAndBirth(c.patient, of_case.patient);
    });
    if (other == namesakes.end())
        return;
    flagIdOnce(context, *self, other->id);
    flagIdOnce(context, *other, of_case.id);
}

}  // namespace vicon::ingest
