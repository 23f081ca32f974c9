#include <algorithm>
#include <cstdio>

#include "../command.h"
#include "vicon/cases/report_content.h"
#include "vicon/cases/report_versions.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/report/forms.h"

namespace vicon::app {
namespace {

struct ExportArguments {
    std::string case_id, form, out;
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

std::string formOf(const std::string& form, const std::optional<ReportVersion>& version, const nlohmann::json& content)
{
    if (form == "json")
        return reportDocument(version, content).dump(2) + "\n";
    const ReadCase read = readCaseFromContent(content);
    return form == "csv" ? report::asCsv(read) : report::asText(read, version);
}

int exportReport(Context& context, const ExportArguments& a)
{
    CaseStore& store = context.existingStore();
    const std::string case_id = store.requireCase(a.case_id).id;
    const auto version = versionFor(store, case_id, a);
    const nlohmann::json content =
        version ? nlohmann::json::parse(version->content) : reportContent(readCase(store, case_id));
    const std::string text = formOf(context.json ? "json" : a.form, version, content);
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
    return {"export", "Write a case's report in another form: JSON, CSV of its findings, or plain text",
            [](CommandLine& command) {
                auto a = std::make_shared<ExportArguments>();
                command.option("CASE", a->case_id, "The case's id").required();
                command.option("--as", a->form, "json, csv or text").required().check(oneOf({"json", "csv", "text"}));
                command.option("--out", a->out, "The file (default: printed)").typeName("FILE");
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
