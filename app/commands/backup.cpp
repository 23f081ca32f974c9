#include "vicon/cases/backup.h"

#include <cstdio>

#include "../command.h"
#include "../operation_audit.h"
#include "../progress_line.h"
#include "../text_table.h"

namespace vicon::app {
namespace {

/// Exit code of what was done but for the files that it lists: neither a success nor a failure, and told apart from
/// both.
constexpr int kNotWhole = 3;

nlohmann::json faultsJson(const std::vector<FileFault>& faults)
{
    nlohmann::json out = nlohmann::json::array();
    for (const FileFault& fault : faults)
        out.push_back({{"case", fault.case_id}, {"file", fault.file.string()}, {"fault", nameOf(fault.kind)}});
    return out;
}

void print(const Context& context, const CopyCounts& copied)
{
    constexpr double kBytesAGb = 1e9;
    if (context.json) {
        const nlohmann::json out = {{"cases", copied.cases},
                                    {"files", copied.files},
                                    {"copied", copied.copied},
                                    {"removed", copied.removed},
                                    {"bytes_copied", copied.bytes_copied},
                                    {"faults", faultsJson(copied.faults)}};
        std::printf("%s\n", out.dump(2).c_str());
        return;
    }
    std::printf("%d cases, %d files; %d of them copied (%s GB), %d removed\n", copied.cases, copied.files,
                copied.copied, formatNumber(double(copied.bytes_copied) / kBytesAGb, 1).c_str(), copied.removed);
    for (const FileFault& fault : copied.faults)
        std::printf("  ! %s\n", textOf(fault).c_str());
    if (!copied.faults.empty())
        std::printf("not whole: %zu files lost or changed; the rest is there\n", copied.faults.size());
}

std::string detailOf(const CopyCounts& copied)
{
    return std::to_string(copied.cases) + " cases" +
           (copied.faults.empty() ? "" : ", " + std::to_string(copied.faults.size()) + " files at fault");
}

/// What is not whole must show, also to a script.
int end(Context& context, AuditEvent event, const CopyCounts& copied)
{
    auditOperation(context.storePlace(), event, detailOf(copied));
    print(context, copied);
    return copied.faults.empty() ? 0 : kNotWhole;
}

int backup(Context& context, const std::string& to)
{
    ProgressLine progress("backup");
    const CopyCounts copied = backUp(context.existingStore(), to, progress);
    progress.clear();
    return end(context, AuditEvent::store_backed_up, copied);
}

int restoreFrom(Context& context, const std::string& from)
{
    context.config();  // a wrong configuration is told before anything is made
    ProgressLine progress("restore");
    const CopyCounts copied = restore(from, context.storePlace(), progress);
    progress.clear();
    return end(context, AuditEvent::store_restored, copied);
}

}  // namespace

Subcommand backupCommand()
{
    return {"backup", "Copy the store into a folder while it is in use; a later backup there copies only what is new",
            [](CommandLine& command) {
                auto to = std::make_shared<std::string>();
                command.option("FOLDER", *to, "Where the backup lies; best on another disk").required();
                return [to](Context& context) { return backup(context, *to); };
            }};
}

Subcommand restoreCommand()
{
    return {"restore", "Make a store of a backup, and check every object in it", [](CommandLine& command) {
                auto from = std::make_shared<std::string>();
                command.option("FOLDER", *from, "The backup").required().check(existingPath());
                return [from](Context& context) { return restoreFrom(context, *from); };
            }};
}

}  // namespace vicon::app
