#include <cstdio>

#include "../command.h"
#include "../progress_line.h"
#include "../report_writing.h"
#include "vicon/cases/whole_id.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

int sign(Context& context, const std::string& case_id, bool preliminary)
{
    ProgressLine progress(preliminary ? "report" : "signing");
    const GivenReport given = giveOutReport(context.existingStore(), context.config(), case_id, !preliminary, progress);
    progress.clear();
    for (const std::string& warning : given.warnings)
        std::fprintf(stderr, "vicon: %s\n", warning.c_str());
    const ReportVersion& version = given.version;
    if (context.json) {
        nlohmann::json out = toJson(version);
        out["file"] = version.file.string();
        out["pages"] = given.pages;
        out["warnings"] = given.warnings;
        std::printf("%s\n", out.dump(2).c_str());
        return 0;
    }
    std::printf("%s by %s at %s: version %d, %d pages\ndigest %s\n%s\n", nameOf(version.state).c_str(),
                version.person.c_str(), version.at.c_str(), version.version, given.pages, version.digest.c_str(),
                version.file.c_str());
    return 0;
}

int amend(Context& context, const std::string& given_id, const std::string& reason, bool cancel)
{
    CaseStore& store = context.existingStore();
    const std::string case_id = requireCase(store, given_id, IdPart::whole).id;
    const auto options = context.config().get<SigningOptions>();
    if (cancel)
        cancelAmendment(store, options, case_id);
    else
        beginAmendment(store, options, case_id, reason);
    const ReportStatus status = reportStatus(store, case_id);
    if (context.json)
        std::printf("%s\n", nlohmann::json{{"case", case_id},
                                           {"state", nameOf(status.state)},
                                           {"version", status.version},
                                           {"amending", status.amending},
                                           {"reason", status.reason}}
                                .dump(2)
                                .c_str());
    else
        std::printf("%s\n", textOf(status).c_str());
    return 0;
}

}  // namespace

Subcommand signCommand()
{
    return {"sign", "Sign a case's report: it never changes afterwards", [](CommandLine& command) {
                auto case_id = std::make_shared<std::string>();
                auto preliminary = std::make_shared<bool>(false);
                command.option("CASE", *case_id, "The case's whole id").required();
                command.flag("--preliminary", *preliminary, "Give it out without a signature");
                return [=](Context& context) { return sign(context, *case_id, *preliminary); };
            }};
}

Subcommand amendCommand()
{
    return {
        "amend", "Open a signed report for an amendment; 'vicon sign' ends it", [](CommandLine& command) {
            auto case_id = std::make_shared<std::string>(), reason = std::make_shared<std::string>();
            auto cancel = std::make_shared<bool>(false);
            command.option("CASE", *case_id, "The case's whole id").required();
            const auto why = command.option("--reason", *reason, "Why it is amended").typeName("TEXT");
            command.flag("--cancel", *cancel, "Take a begun amendment back, with all that was changed").excludes(why);
            return [=](Context& context) { return amend(context, *case_id, *reason, *cancel); };
        }};
}

}  // namespace vicon::app
