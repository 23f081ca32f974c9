#include "vicon/cases/report_versions.h"

#include <algorithm>

#include "case_rows.h"
#include "comparison_rows.h"
#include "report_rows.h"
#include "this_person.h"
#include "version_objects.h"
#include "vicon/cases/report_content.h"
#include "vicon/cases/report_files.h"
#include "vicon/cases/roles.h"
#include "vicon/core/enum_names.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon {
namespace {

constexpr EnumNames<ReportState, 4> kStateNames = {{{ReportState::draft, "draft"},
                                                    {ReportState::preliminary, "preliminary"},
                                                    {ReportState::final, "signed"},
                                                    {ReportState::amended, "amended"}}};

ReportVersion versionFrom(const soci::row& row)
{
    ReportVersion v;
    v.version = row.get<int>("version");
    v.state = valueIn(kStateNames, row.get<std::string>("state"), "a report's state");
    v.replaces = row.get<int>("replaces");
    v.reason = row.get<std::string>("reason");
    v.person = row.get<std::string>("person");
    v.at = row.get<std::string>("at");
    v.software = row.get<std::string>("software");
    v.digest = row.get<std::string>("digest");
    v.content = row.get<std::string>("content");
    v.file = row.get<std::string>("file");
    v.file_sha256 = row.get<std::string>("file_sha256");
    v.objects = objectHashesFrom(row.get<std::string>("objects"));
    return v;
}

void requireSigner(CaseStore& store, const std::string& case_id, const SigningOptions& options)
{
    const std::string person = thisPerson();
    if (isAmong(person, options.signers))
        return;
    store.audit(AuditEvent::account_refused, case_id, "", "may not sign reports");
    throw Error(ErrorCode::bad_input, "this account may not sign reports", "'" + person + "'",
                "who runs VICON here names those who may in the configuration: [roles] sign = [\"" + person + "\"]");
}

void requireComplete(const ReadCase& read)
{
    std::string all;
    for (const std::string& line : missingForSignature(read))
        all += (all.empty() ? "" : "; ") + line;
    if (!all.empty())
        throw Error(ErrorCode::bad_input, "the report cannot be signed: " + all, read.record.id,
                    "'vicon finding' and 'vicon assess' complete it");
}

/// A file that a kill left without its row says "signed" and is not.
void removeUnnamedFile(CaseStore& store, const std::string& case_id)
{
    const auto next = [&](soci::session& sql) {
        return reportFolder(store, case_id) / versionName(int(versionsIn(sql, case_id).size()) + 1);
    };
    if (!fs::exists(store.database().read(next)))
        return;
    store.database().write([&](soci::session& sql) {  // nobody is just writing it
        std::error_code ignored;
        fs::remove(next(sql), ignored);
    });
}

/// The last signed version; 0: none.
int lastSigned(const std::vector<ReportVersion>& versions)
{
    int last = 0;
    for (const ReportVersion& v : versions)
        if (v.isSigned())
            last = v.version;
    return last;
}

AuditEvent eventOf(ReportState state)
{
    switch (state) {
        case ReportState::final:
            return AuditEvent::report_signed;
        case ReportState::amended:
            return AuditEvent::report_amended;
        case ReportState::draft:  // no version is one
        case ReportState::preliminary:
            break;
    }
    return AuditEvent::report_preliminary;
}

void putVersion(soci::session& sql, const std::string& case_id, const ReportVersion& v)
{
    const std::string state = nameOf(v.state), file = v.file.filename().string();
    const json objects = v.objects.value_or(ObjectHashes());
    const std::string hashes = objects.dump();
    sql << "INSERT INTO report_versions (case_id, version, state, replaces, reason, person, at, software, digest,"
           " content, file, file_sha256, objects) VALUES (:case, :version, :state, :replaces, :reason, :person, :at,"
           " :software, :digest, :content, :file, :sha, :objects)",
        soci::use(case_id), soci::use(v.version), soci::use(state), soci::use(v.replaces), soci::use(v.reason),
        soci::use(v.person), soci::use(v.at), soci::use(v.software), soci::use(v.digest), soci::use(v.content),
        soci::use(file), soci::use(v.file_sha256), soci::use(hashes);
    json said = toJson(v);
    said["objects"] = objects;
    putAudit(sql, {eventOf(v.state), case_id, "", "version " + std::to_string(v.version), "", said.dump()});
}

void requireNoneFaster(soci::session& sql, const std::string& case_id, const ReportVersion& wanted)
{
    const auto versions = versionsIn(sql, case_id);
    if (versions.empty() ? wanted.version == 1 : versions.back().version + 1 == wanted.version)
        return;
    const ReportVersion& faster = versions.back();
    throw Error(ErrorCode::bad_input,
                "the report was made " + nameOf(faster.state) + " by " + faster.person + " at " + faster.at +
                    " meanwhile; nothing was written",
                case_id, "read version " + std::to_string(faster.version) + " first");
}

}  // namespace

std::string nameOf(ReportState state)
{
    return nameIn(kStateNames, state);
}

json toJson(const ReportVersion& v)
{
    return {{"version", v.version},        {"state", nameOf(v.state)}, {"replaces", v.replaces},
            {"reason", v.reason},          {"person", v.person},       {"at", v.at},
            {"software", v.software},      {"digest", v.digest},       {"file", v.file.filename().string()},
            {"file_sha256", v.file_sha256}};
}

json reportDocument(const std::optional<ReportVersion>& version, const json& content)
{
    json out = {{"state", nameOf(version ? version->state : ReportState::draft)}, {"content", content}};
    if (version)
        out["version"] = toJson(*version);
    return out;
}

std::string digestOf(std::string_view content, std::string_view file_sha256)
{
    return sha256(std::string(content) + "\n" + std::string(file_sha256));
}

std::vector<ReportVersion> versionsIn(soci::session& sql, const std::string& case_id)
{
    const soci::rowset<soci::row> rows =
        (sql.prepare << "SELECT * FROM report_versions WHERE case_id = :c ORDER BY version", soci::use(case_id));
    return collect(rows, versionFrom);
}

ReportStatus statusIn(soci::session& sql, const std::string& case_id)
{
    ReportStatus status;
    const auto versions = versionsIn(sql, case_id);
    if (!versions.empty()) {
        status.state = versions.back().state;
        status.version = versions.back().version;
    }
    soci::indicator there = soci::i_null;
    sql << "SELECT reason FROM amendments WHERE case_id = :c", soci::use(case_id), soci::into(status.reason, there);
    status.amending = sql.got_data();
    return status;
}

void requireOpenReport(soci::session& sql, const std::string& case_id)
{
    if (!statusIn(sql, case_id).open())
        throw Error(ErrorCode::wrong_use, "the report is signed; nothing was changed", case_id,
                    "'vicon amend " + case_id + " --reason TEXT' opens it");
}

std::vector<ReportVersion> reportVersions(CaseStore& store, const std::string& case_id)
{
    removeUnnamedFile(store, case_id);
    auto versions = store.database().read([&](soci::session& sql) { return versionsIn(sql, case_id); });
    for (ReportVersion& v : versions)
        v.file = reportFolder(store, case_id) / v.file;
    return versions;
}

std::string faultOf(const ReportVersion& version)
{
    if (digestOf(version.content, version.file_sha256) != version.digest)
        return "its content is not what was kept";
    if (!fs::exists(version.file))
        return "its file is missing";
    if (sha256OfFile(version.file) != version.file_sha256)
        return "its file is not what was kept";
    return faultOfObjects(version);
}

ReportStatus reportStatus(CaseStore& store, const std::string& case_id)
{
    return store.database().read([&](soci::session& sql) { return statusIn(sql, case_id); });
}

std::string textOf(const ReportStatus& status)
{
    if (status.amending)
        return "amendment of version " + std::to_string(status.version) + " begun: " + status.reason;
    if (status.version == 0)
        return nameOf(status.state);
    return nameOf(status.state) + ", version " + std::to_string(status.version);
}

void beginAmendment(CaseStore& store, const SigningOptions& options, const std::string& case_id,
                    const std::string& reason)
{
    requireSigner(store, case_id, options);
    if (reason.empty())
        throw Error(ErrorCode::wrong_use, "an amendment needs a reason", case_id, "give it with --reason");
    store.database().write([&](soci::session& sql) {
        const ReportStatus status = statusIn(sql, case_id);
        if (status.amending)
            throw Error(ErrorCode::wrong_use, "an amendment was begun already: " + status.reason, case_id,
                        "'vicon sign " + case_id + "' ends it, 'vicon amend " + case_id + " --cancel' takes it back");
        if (status.open())
            throw Error(ErrorCode::wrong_use, "the report is not signed; change it as it is", case_id);
        const std::string person = thisPerson(), now = nowUtc();
        sql << "INSERT INTO amendments (case_id, reason, person, at) VALUES (:case, :reason, :person, :at)",
            soci::use(case_id), soci::use(reason), soci::use(person), soci::use(now);
        putAudit(sql, AuditEvent::amendment_begun, case_id, "", reason);
    });
}

void cancelAmendment(CaseStore& store, const SigningOptions& options, const std::string& case_id)
{
    requireSigner(store, case_id, options);
    store.database().write([&](soci::session& sql) {
        if (!statusIn(sql, case_id).amending)
            throw Error(ErrorCode::wrong_use, "no amendment was begun", case_id);
        const auto versions = versionsIn(sql, case_id);
        const json signed_content = json::parse(versions.at(std::size_t(lastSigned(versions)) - 1).content);
        const json before = reportContent(readCase(store, case_id));
        sql << "DELETE FROM findings WHERE case_id = :c", soci::use(case_id);
        for (const json& entry : signed_content.at("findings")) {
            const Finding finding = findingFromJson(entry);
            const std::string content = toJson(finding).dump();
            sql << "INSERT INTO findings (case_id, id, content) VALUES (:case, :id, :content)", soci::use(case_id),
                soci::use(finding.id), soci::use(content);
        }
        sql << "DELETE FROM comparisons WHERE case_id = :c", soci::use(case_id);
        for (const ComparedFinding& compared : readCaseFromContent(signed_content).comparisons)
            putComparison(sql, case_id, compared.said);
        const std::string assessment = toJson(assessmentFromJson(signed_content.at("assessment"))).dump();
        sql << "UPDATE assessments SET content = :content WHERE case_id = :c", soci::use(assessment),
            soci::use(case_id);
        sql << "DELETE FROM amendments WHERE case_id = :c", soci::use(case_id);
        const auto said = [](const json& content) {
            return json{{"findings", content.at("findings")},
                        {"comparisons", content.value("comparisons", json::array())},
                        {"assessment", content.at("assessment")}}
                .dump();
        };
        putAudit(sql, {AuditEvent::amendment_cancelled, case_id, "", "", said(before), said(signed_content)});
    });
}

VersionDraft draftVersion(CaseStore& store, const SigningOptions& options, const std::string& case_id, bool sign,
                          const std::string& software)
{
    if (sign)
        requireSigner(store, case_id, options);
    removeUnnamedFile(store, case_id);
    const ReportStatus status = reportStatus(store, case_id);
    if (!status.open())
        throw Error(ErrorCode::bad_input, "the report is signed already", case_id,
                    "'vicon amend " + case_id + " --reason TEXT' opens it");
    if (!sign && status.amending)
        throw Error(ErrorCode::bad_input, "an amendment is signed, not made preliminary", case_id,
                    "'vicon sign " + case_id + "' ends it");
    const ReadCase read = readCase(store, case_id);
    if (sign)
        requireComplete(read);
    VersionDraft draft;
    draft.content = reportContent(read);
    draft.version.version = status.version + 1;
    draft.version.replaces = status.amending ? status.version : 0;
    draft.version.reason = status.reason;
    draft.version.state = !sign             ? ReportState::preliminary
                          : status.amending ? ReportState::amended
                                            : ReportState::final;
    draft.version.person = thisPerson();
    draft.version.at = nowUtc();
    draft.version.software = software;
    return draft;
}

ReportVersion versionWith(const CaseStore& store, const std::string& case_id, const VersionDraft& draft,
                          std::string_view pdf)
{
    ReportVersion version = draft.version;
    version.content = draft.content.dump();
    version.file_sha256 = sha256(pdf);
    version.digest = digestOf(version.content, version.file_sha256);
    version.file = reportFolder(store, case_id) / versionName(version.version);
    return version;
}

ReportVersion keepVersion(CaseStore& store, const std::string& case_id, const VersionDraft& draft, std::string_view pdf,
                          const VersionObjects& objects)
{
    ReportVersion kept = versionWith(store, case_id, draft, pdf);
    kept.objects = hashesOf(objects.files);
    makePrivateFolder(reportFolder(store, case_id));
    store.database().write([&](soci::session& sql) {
        requireNoneFaster(sql, case_id, kept);
        requireOpenReport(sql, case_id);
        if (reportContent(readCase(store, case_id)) != draft.content)
            throw Error(ErrorCode::bad_input, "the case was changed while the report was drawn; nothing was written",
                        case_id, "look at it as it is now, and do it again if you still want it");
        putVersion(sql, case_id, kept);
        sql << "DELETE FROM amendments WHERE case_id = :c", soci::use(case_id);
        // Last, and while nobody else can write: a kill before the commit leaves a file that no version names, which
        // the version that takes its number replaces.
        replaceFile(kept.file, pdf);
        putObjects(kept, objects.files);
        if (objects.also)
            objects.also(sql, kept);
    });
    return kept;
}

}  // namespace vicon
