#include <cstdio>

#include "../command.h"
#include "../progress_line.h"
#include "../text_table.h"
#include "vicon/cases/case_deletion.h"
#include "vicon/cases/report_versions.h"
#include "vicon/cases/whole_id.h"

namespace vicon::app {
namespace {

struct DeleteArguments {
    std::string case_id;
    bool yes = false, lose = false;
};

void printDoubts(const DeletionDoubts& doubts)
{
    for (const auto* lines : {&doubts.forbidding, &doubts.losses})
        for (const std::string& line : *lines)
            std::printf("! %s\n", line.c_str());
}

/// How it is deleted after all.
const char* adviceFor(const DeletionDoubts& doubts)
{
    if (!doubts.forbidding.empty())
        return "nothing was deleted, and cannot be before that ends";
    return doubts.losses.empty() ? "nothing was deleted; --yes deletes it"
                                 : "nothing was deleted; --yes --lose deletes it";
}

int deleteOne(Context& context, const DeleteArguments& arguments)
{
    CaseStore& store = context.existingStore();
    const std::string id = requireCase(store, arguments.case_id, IdPart::whole).id;
    const CaseSize size = sizeOfCase(store, id);
    const DeletionDoubts doubts = doubtsAboutDeleting(store, id);
    const std::string report = textOf(reportStatus(store, id));
    if (arguments.yes) {
        ProgressLine progress("delete");
        deleteCase(store, id, arguments.lose, "deleted by hand", progress);
    }
    if (context.json) {
        const nlohmann::json out = {{"case", id},
                                    {"scans", size.scans},
                                    {"objects", size.objects},
                                    {"bytes", size.bytes},
                                    {"report", report},
                                    {"forbidding", doubts.forbidding},
                                    {"losses", doubts.losses},
                                    {"deleted", arguments.yes}};
        std::printf("%s\n", out.dump(2).c_str());
        return 0;
    }
    constexpr double kBytesAGb = 1e9;
    std::printf("%s: %d scans, %d objects, %s GB, report %s\n", id.c_str(), size.scans, size.objects,
                formatNumber(double(size.bytes) / kBytesAGb, 1).c_str(), report.c_str());
    if (!arguments.yes)
        printDoubts(doubts);
    std::printf("%s\n", arguments.yes ? "deleted" : adviceFor(doubts));
    return 0;
}

}  // namespace

Subcommand deleteCommand()
{
    return {"delete", "Delete a case with its images, results and reports; without --yes it says what that would be",
            [](CommandLine& command) {
                auto arguments = std::make_shared<DeleteArguments>();
                command.option("CASE", arguments->case_id, "The case's whole id").required();
                command.flag("--yes", arguments->yes, "Delete it");
                command.flag("--lose", arguments->lose,
                             "Also where a report is not signed, or an object not delivered: they are lost");
                return [arguments](Context& context) { return deleteOne(context, *arguments); };
            }};
}

}  // namespace vicon::app
