#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/core/options.h"

namespace vicon {

struct SigningOptions {
    std::vector<std::string> signers;
    std::vector<std::string> send_to;
    std::vector<std::string> objects{"pdf", "sr", "key", "lumen", "picture"};

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("roles.sign", signers, "", "Local accounts, or @GROUP, that may sign reports; none: nobody may.");
        v("report.send_to", send_to, "", "Peers that every signed report goes to, by their names in [peers].");
        v("report.objects", objects, "",
          "DICOM objects that a signed report is made into: pdf, sr (measurements), key (slices with findings), lumen "
          "(segmentation), picture (secondary captures).");
    }
};

/// What a report is, or what a version of it was made as.
enum class ReportState {
    draft,        ///< nothing was given out; no version is one
    preliminary,  ///< given out, not signed
    final,        ///< signed
    amended,      ///< signed in place of an earlier signed version, which stays
};
/// "draft", "preliminary", "signed", "amended".
std::string nameOf(ReportState state);

/// A version of a case's report that was given out. It never changes: the database refuses.
struct ReportVersion {
    int version = 0;  ///< 1, 2, ...
    ReportState state = ReportState::preliminary;
    int replaces = 0;      ///< the signed version that it amends; 0: none
    std::string reason;    ///< of the amendment
    std::string person;    ///< local account
    std::string at;        ///< UTC
    std::string software;  ///< "0.1.0"
    std::string digest;    ///< SHA-256 of the content's text, a line break and `file_sha256`
    std::string content;   ///< what it says: JSON, as reportContent() gave it
    std::filesystem::path file;
    std::string file_sha256;
    /// SHA-256 of each of its DICOM objects, by the file's name; nothing where an earlier VICON kept none.
    std::optional<std::map<std::string, std::string>> objects;

    bool isSigned() const { return state != ReportState::preliminary; }
};
/// Without its content.
nlohmann::json toJson(const ReportVersion& version);
/// What a case's report says, as docs/dev/schemas/report.schema.json has it. @param version absent: the draft
nlohmann::json reportDocument(const std::optional<ReportVersion>& version, const nlohmann::json& content);
std::string digestOf(std::string_view content, std::string_view file_sha256);

/// All versions of a case's report, the first one first.
std::vector<ReportVersion> reportVersions(CaseStore& store, const std::string& case_id);
/// What is no longer as it was signed: "its file is missing", "version-1-sr.dcm is not what was kept", ...; empty where
/// all of it is. Nothing is known of objects whose hashes were not kept.
std::string faultOf(const ReportVersion& version);
/// The DICOM objects of a version, by name. Throws Error{store} where one is missing or not what was kept.
std::vector<std::filesystem::path> requireObjects(const ReportVersion& version);

struct ReportStatus {
    ReportState state = ReportState::draft;  ///< of the last version
    int version = 0;                         ///< the last one; 0: none
    bool amending = false;                   ///< an amendment was begun and is not signed
    std::string reason;                      ///< of the amendment

    /// Findings and assessment may be changed.
    bool open() const { return state == ReportState::draft || state == ReportState::preliminary || amending; }
};
ReportStatus reportStatus(CaseStore& store, const std::string& case_id);
/// "draft", "signed, version 1", "amendment of version 1 begun".
std::string textOf(const ReportStatus& status);

/// Opens a signed report for changes. Throws Error{wrong_use} where it is not signed, an amendment was begun already,
/// or the reason is empty.
void beginAmendment(CaseStore& store, const SigningOptions& options, const std::string& case_id,
                    const std::string& reason);
/// Takes a begun amendment back: findings and assessment become what was signed. Throws Error{wrong_use} where none was
/// begun.
void cancelAmendment(CaseStore& store, const SigningOptions& options, const std::string& case_id);

/// What shall become a version, to be drawn and then kept.
struct VersionDraft {
    ReportVersion version;  ///< without file and digest
    nlohmann::json content;
};
/// Makes one of the case as it is now, by who works here. Throws Error{bad_input}: with all that is missing for a
/// signature; for one who may not sign; where the report is signed already.
VersionDraft draftVersion(CaseStore& store, const SigningOptions& options, const std::string& case_id, bool sign,
                          const std::string& software);
/// The version that a draft becomes with this PDF, with its digest; nothing is kept yet.
ReportVersion versionWith(const CaseStore& store, const std::string& case_id, const VersionDraft& draft,
                          std::string_view pdf);

/// What is kept beside a version's PDF.
struct VersionObjects {
    /// Files outside the store; each goes into the case's report folder under its name, which versionObjects() knows.
    std::vector<std::filesystem::path> files;
    /// Runs last within the transaction, when all files lie in the folder; may be empty.
    std::function<void(soci::session&, const ReportVersion&)> also = {};
};
/// Keeps it with its PDF and its objects, as a whole or not at all. Throws Error{bad_input} where the case is no longer
/// what the draft says, also where somebody else was faster; Error{store} and Error{database} where it cannot be
/// written. Nothing was kept then.
ReportVersion keepVersion(CaseStore& store, const std::string& case_id, const VersionDraft& draft, std::string_view pdf,
                          const VersionObjects& objects = {});

}  // namespace vicon
