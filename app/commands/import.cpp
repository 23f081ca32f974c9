#include "vicon/ingest/import.h"

#include <cstdio>

#include "../command.h"
#include "../lumen_import.h"
#include "../operation_audit.h"
#include "../progress_line.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

struct ImportArguments {
    std::vector<std::string> paths;
    std::vector<std::string> mask;  ///< CASE SCAN FILE
    int label = 0;
    bool label_given = false;
};

void print(const Context& context, const std::vector<ingest::ImportLine>& lines)
{
    nlohmann::json all = nlohmann::json::array();
    for (const ingest::ImportLine& line : lines)
        if (context.json)
            all.push_back(toJson(line));
        else
            std::printf("%-11s %s: %s\n", ingest::nameOf(line.kind).c_str(), line.subject.c_str(), line.text.c_str());
    if (context.json)
        std::printf("%s\n", nlohmann::json{{"lines", all}}.dump(2).c_str());
}

int importMask(Context& context, const ImportArguments& arguments)
{
    const LumenImport asked{.case_id = arguments.mask.at(0),
                            .scan_id = arguments.mask.at(1),
                            .file = arguments.mask.at(2),
                            .label = arguments.label_given ? std::optional(arguments.label) : std::nullopt};
    ProgressLine progress("import");
    const auto lines = importLumen(context.existingStore(), context.config(), asked, progress);
    progress.clear();
    print(context, lines);
    return 0;
}

int import(Context& context, const ImportArguments& arguments)
{
    if (arguments.paths.empty() == arguments.mask.empty())
        throw Error(ErrorCode::wrong_use, "files to import, or --mask with a case, a scan and a file, are needed", {},
                    "see 'vicon import --help'");
    if (!arguments.mask.empty())
        return importMask(context, arguments);
    ProgressLine progress("import");
    const ingest::ImportReport report =
        ingest::importPaths(context.store(), {arguments.paths.begin(), arguments.paths.end()},
                            context.config().get<ingest::ImportOptions>(), progress);
    progress.clear();
    auditOperation(context.storePlace(), AuditEvent::files_imported,
                   std::to_string(report.scans_stored) + " scans new or grown");
    print(context, report.lines);
    return report.anythingStored() ? 0 : 1;
}

}  // namespace

Subcommand importCommand()
{
    return {"import", "Import DICOM files, folders, DICOMDIRs or zip files into cases and queue their scans",
            [](CommandLine& command) {
                auto arguments = std::make_shared<ImportArguments>();
                command.option("PATH", arguments->paths, "Files, folders (searched recursively), DICOMDIR or zip files")
                    .check(existingPath());
                const CommandOption mask =
                    command
                        .option("--mask", arguments->mask,
                                "Another program's lumen for a scan instead of the one that VICON finds: DICOM SEG, "
                                "NIfTI, NRRD or MetaImage; 'none' as FILE: VICON finds it itself again")
                        .typeName("CASE SCAN FILE")
                        .values(3);
                const CommandOption label =
                    command.option("--label", arguments->label, "The lumen's label where the mask's file has several")
                        .typeName("N")
                        .check(range(1, 65535))
                        .needs(mask);
                return [arguments, label](Context& context) {
                    arguments->label_given = label.given();
                    return import(context, *arguments);
                };
            }};
}

}  // namespace vicon::app
