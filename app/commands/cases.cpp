#include <cstdio>

#include "../command.h"
#include "../text_table.h"
#include "vicon/cases/worklist.h"

namespace vicon::app {
namespace {

int cases(Context& context)
{
    CaseStore& store = context.existingStore();
    const auto worklist = makeWorklist(store, context.config().get<QueueOptions>());
    if (context.json) {
        std::printf("%s\n", toJson(worklist).dump(2).c_str());
        return 0;
    }
    if (worklist.empty()) {
        std::printf("no cases; 'vicon import PATH' brings some in\n");
        return 0;
    }
    std::vector<std::vector<std::string>> rows;
    for (const WorklistCase& c : worklist)
        rows.push_back({c.record.id, c.record.patient.name, c.record.patient.id, c.record.study.date,
                        std::to_string(c.scans.size()), std::to_string(c.markers), nameOf(c.state), c.delivery,
                        c.reason});
    std::printf("%s",
                formatTable({"CASE", "PATIENT", "ID", "DATE", "SCANS", "MARKERS", "STATE", "SENT", ""}, rows).c_str());
    return 0;
}

}  // namespace

Subcommand casesCommand()
{
    return {"cases", "List the cases of the store: the worklist",
            [](CommandLine&) { return [](Context& context) { return cases(context); }; }};
}

}  // namespace vicon::app
