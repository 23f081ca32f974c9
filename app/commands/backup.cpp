#include "vicon/cases/backup.h"

#include <cstdio>

#include "../command.h"
#include "../operation_audit.h"
#include "../progress_line.h"
#include "../text_table.h"

namespace vicon::app {
namespace {

void print(const Context& context, const CopyCounts& copied)
{
    constexpr double kBytesAGb = 1e9;
    if (context.json) {
        const nlohmann::json out = {{"cases", copied.cases},
                                    {"files", copied.files},
                                    {"copied", copied.copied},
                                    {"removed", copied.removed},
                                    {"bytes_copied", copied.bytes_copied}};
        std::printf("%s\n", out.dump(2).c_str());
        return;
    }
    std::printf("%d cases, %d files; %d of them copied (%s GB), %d removed\n", copied.cases, copied.files,
                copied.copied, formatNumber(double(copied.bytes_copied) / kBytesAGb, 1).c_str(), copied.removed);
}

int backup(Context& context, const std::string& to)
{
    ProgressLine progress("backup");
    const CopyCounts copied = backUp(context.existingStore(), to, progress);
    progress.clear();
    auditOperation(context.storePlace(), AuditEvent::store_backed_up, std::to_string(copied.cases) + " cases");
    print(context, copied);
    return 0;
}

int restoreFrom(Context& context, const std::string& from)
{
    context.config();  // a wrong configuration is told before anything is made
    ProgressLine progress("restore");
    const CopyCounts copied = restore(from, context.storePlace(), progress);
    progress.clear();
    auditOperation(context.storePlace(), AuditEvent::store_restored, std::to_string(copied.cases) + " cases");
    print(context, copied);
    return 0;
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
