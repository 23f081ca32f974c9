#include <algorithm>
#include <cstdio>

#include "../command.h"
#include "vicon/cases/report_content.h"
#include "vicon/cases/report_files.h"
#include "vicon/cases/report_versions.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/report/forms.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

enum class ExportForm { text, json, csv, fhir, hl7, dicom };
constexpr EnumNames<ExportForm, 6> kExportFormNames{{
    {ExportForm::text, "text"},
    {ExportForm::json, "json"},
    {ExportForm::csv, "csv"},
    {ExportForm::fhir, "fhir"},
    {ExportForm::hl7, "hl7"},
    {ExportForm::dicom, "dicom"},
}};
constexpr const auto& optionNames(ExportForm /*value*/)
{
    return kExportFormNames;
}

struct ExportArguments {
    std::string case_id, out;
    ExportForm form = ExportForm::text;
    int version = 0;  // 0: the last one that was given out, or the draft
    bool draft = false;
};

/// What is exported: a version, or what would be one now.
std::optional<ReportVersion> versionFor(CaseStore& store, const std::string& case_id, const ExportArguments& a)
{
    const std::vector<ReportVersion> versions = reportVersions(store, case_id);
    if (a.version == 0)
        return versions.empty() || a.draft ? std::nullopt : std::optional(versions.back());
    const auto found =
        std::find_if(versions.begin(), versions.end(), [&](const ReportVersion& v) { return v.version == a.version; });
    if (found == versions.end())
        throw Error(ErrorCode::not_found, "the report has no version " + std::to_string(a.version), case_id,
                    "'vicon audit " + case_id + "' lists them");
    return *found;
}

/// The DICOM objects of a signed version, copied into a folder.
int exportObjects(CaseStore& store, const std::string& case_id, const std::optional<ReportVersion>& version,
                  const fs::path& folder)
{
    if (folder.empty())
        throw Error(ErrorCode::wrong_use, "DICOM objects need a folder", case_id, "give one with --out");
    if (!version || !version->isSigned())
        throw Error(ErrorCode::bad_input, "only a signed report has DICOM objects", case_id,
                    "'vicon sign " + case_id + "' signs it");
    const std::vector<fs::path> objects = requireObjects(*version);
    fs::create_directories(folder);
    store.audit(AuditEvent::report_exported, case_id, "", "dicom");
    for (const fs::path& object : objects) {
        const fs::path copy = folder / object.filename();
        replaceFile(copy, readFile(object));
        std::printf("%s\n", copy.c_str());
    }
    return 0;
}

std::string formOf(ExportForm form, const std::optional<ReportVersion>& version, const nlohmann::json& content)
{
    if (form == ExportForm::json)
        return reportDocument(version, content).dump(2) + "\n";
    const ReadCase read = readCaseFromContent(content);
    switch (form) {
        case ExportForm::text:
            return report::asText(read, version);
        case ExportForm::csv:
            return report::asCsv(read);
        case ExportForm::fhir:
            return report::asFhir(read, version).dump(2) + "\n";
        case ExportForm::hl7:
            return report::asHl7(read, version);
        case ExportForm::json:
        case ExportForm::dicom:
            break;
    }
    throw Error(ErrorCode::internal, "a report has no such text");
}

int exportReport(Context& context, const ExportArguments& a)
{
    CaseStore& store = context.existingStore();
    const std::string case_id = store.requireCase(a.case_id).id;
    const auto version = versionFor(store, case_id, a);
    if (context.json && a.form != ExportForm::json)
        throw Error(ErrorCode::wrong_use, "another form than JSON is asked for", "--json", "leave one of them out");
    if (a.form == ExportForm::dicom)
        return exportObjects(store, case_id, version, a.out);
    if (!version)
        requireReportable(store, store.requireCase(case_id));
    const nlohmann::json content =
        version ? nlohmann::json::parse(version->content) : reportContent(readCase(store, case_id));
    const std::string text = formOf(a.form, version, content);
    store.audit(AuditEvent::report_exported, case_id, "", nameIn(kExportFormNames, a.form));
    if (a.out.empty()) {
        std::fwrite(text.data(), 1, text.size(), stdout);
        return 0;
    }
    replaceFile(a.out, text);
    std::printf("%s\n", a.out.c_str());
    return 0;
}

}  // namespace

Subcommand exportCommand()
{
    return {"export", "Write a case's report in another form: plain text, JSON, CSV, FHIR, HL7, or its DICOM objects",
            [](CommandLine& command) {
                auto a = std::make_shared<ExportArguments>();
                command.option("CASE", a->case_id, "The case's id").required();
                command.option("--as", a->form, "text, json, csv (of its findings), fhir (R4 bundle), hl7 (ORU), dicom")
                    .required();
                command.option("--out", a->out, "The file (default: printed); of dicom the folder").typeName("PATH");
                const auto version =
                    command.option("--version-number", a->version, "This version, in place of the last one")
                        .typeName("N")
                        .check(range(1, 1'000'000));
                command.flag("--draft", a->draft, "What it would say now, though a version was given out")
                    .excludes(version);
                return [=](Context& context) { return exportReport(context, *a); };
            }};
}

}  // namespace vicon::app
