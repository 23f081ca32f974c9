#include "vicon/ingest/import.h"

#include <cstdio>

#include "../command.h"
#include "../progress_line.h"

namespace vicon::app {
namespace {

nlohmann::json toJson(const ingest::ImportReport& report)
{
    nlohmann::json lines = nlohmann::json::array();
    for (const ingest::ImportLine& line : report.lines)
        lines.push_back(toJson(line));
    return {{"lines", lines}};
}

int import(Context& context, const std::vector<std::string>& paths)
{
    ProgressLine progress("import");
    const ingest::ImportReport report = ingest::importPaths(context.store(), {paths.begin(), paths.end()},
                                                            context.config().get<ingest::ImportOptions>(), progress);
    progress.clear();
    if (context.json)
        std::printf("%s\n", toJson(report).dump(2).c_str());
    else
        for (const ingest::ImportLine& line : report.lines)
            std::printf("%-11s %s: %s\n", ingest::nameOf(line.kind).c_str(), line.subject.c_str(), line.text.c_str());
    return report.anythingStored() ? 0 : 1;
}

}  // namespace

Subcommand importCommand()
{
    return {"import", "Import DICOM files, folders, DICOMDIRs or zip files into cases and queue their scans",
            [](CommandLine& command) {
                auto paths = std::make_shared<std::vector<std::string>>();
                command.option("PATH", *paths, "Files, folders (searched recursively), DICOMDIR or zip files")
                    .required()
                    .check(existingPath());
                return [paths](Context& context) { return import(context, *paths); };
            }};
}

}  // namespace vicon::app
