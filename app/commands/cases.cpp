#include <cstdio>

#include "../command.h"
#include "../text_table.h"
#include "vicon/cases/worklist.h"

namespace vicon::app {
namespace {

struct CasesArguments {
    int most = 0;
    std::string search, after;

    bool byPages() const { return most > 0 || !search.empty() || !after.empty(); }
};

WorklistPage wanted(Context& context, const CasesArguments& arguments)
{
    CaseStore& store = context.existingStore();
    const auto options = context.config().get<QueueOptions>();
    if (!arguments.byPages())
        return {makeWorklist(store, options)};
    WorklistPageWanted page{.words = arguments.search, .after = arguments.after};
    if (arguments.most > 0)
        page.most = arguments.most;
    return makeWorklistPage(store, options, page);
}

/// What is being done with a case, and how far it is.
std::string stateOf(const WorklistCase& a_case)
{
    if (a_case.state != WorkState::running)
        return nameOf(a_case.state);
    return nameOf(a_case.state) + " " + formatNumber(100 * a_case.progress, 0) + " %";
}

int cases(Context& context, const CasesArguments& arguments)
{
    const WorklistPage page = wanted(context, arguments);
    const std::vector<WorklistCase>& worklist = page.cases;
    if (context.json) {
        std::printf("%s\n", toJson(worklist).dump(2).c_str());
        return 0;
    }
    if (worklist.empty()) {
        std::printf("%s\n", arguments.byPages() ? "no such cases" : "no cases; 'vicon import PATH' brings some in");
        return 0;
    }
    std::vector<std::vector<std::string>> rows;
    for (const WorklistCase& c : worklist)
        rows.push_back({c.record.id, c.record.patient.name, c.record.patient.id, c.record.study.date,
                        std::to_string(c.scans.size()), std::to_string(c.markers), stateOf(c), c.delivery, c.reason});
    std::printf("%s",
                formatTable({"CASE", "PATIENT", "ID", "DATE", "SCANS", "MARKERS", "STATE", "SENT", ""}, rows).c_str());
    if (page.more && arguments.search.empty())
        std::printf("more with --after %s\n", worklist.back().record.id.c_str());
    else if (page.more)
        std::printf("there are more; search for more words, or say --most\n");
    return 0;
}

}  // namespace

Subcommand casesCommand()
{
    return {"cases", "List the cases of the store: the worklist", [](CommandLine& command) {
                auto arguments = std::make_shared<CasesArguments>();
                command
                    .option("--most", arguments->most, "So many, the newest first; else all, or 100 that are searched")
                    .check(range(1, 100'000));
                command.option("--after", arguments->after, "The page after the one that ended with this case")
                    .typeName("CASE");
                command
                    .option("--search", arguments->search,
                            "Beginnings of parts of the name, of ID, accession number, study date or case id")
                    .typeName("WORDS");
                return [arguments](Context& context) { return cases(context, *arguments); };
            }};
}

}  // namespace vicon::app
