#include "vicon/cases/purge.h"

#include <cstdio>

#include "../command.h"
#include "../progress_line.h"
#include "../text_table.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace vicon::app {
namespace {

constexpr double kBytesAGb = 1e9;

/// Deletes it, or says why it stays: somebody may have begun to work on it since the plan was made.
void deleteCandidate(CaseStore& store, PurgeCandidate& candidate)
{
    ProgressLine progress("purge");
    try {
        deleteCase(store, candidate.case_id, false, candidate.rule, progress);
    } catch (const Error& e) {
        if (e.code() == ErrorCode::cancelled || e.code() == ErrorCode::database)
            throw;
        candidate.kept = e.what();
    }
}

void print(const std::vector<PurgeCandidate>& plan, bool done)
{
    std::vector<std::vector<std::string>> rows;
    int going = 0;
    double gb = 0;
    for (const PurgeCandidate& candidate : plan) {
        const double size_gb = double(candidate.size.bytes) / kBytesAGb;
        rows.push_back({candidate.case_id, candidate.last_event, formatNumber(size_gb, 1), candidate.rule,
                        candidate.kept.empty() ? "" : "stays: " + candidate.kept});
        if (!candidate.kept.empty())
            continue;
        ++going;
        gb += size_gb;
    }
    if (!rows.empty())
        std::printf("%s", formatTable({"CASE", "LAST EVENT", "GB", "RULE", ""}, rows).c_str());
    std::printf("%d cases, %s GB %s\n", going, formatNumber(gb, 1).c_str(),
                done ? "deleted" : "would be deleted; --yes deletes them");
}

int purge(Context& context, bool yes)
{
    CaseStore& store = context.existingStore();
    const auto options = context.config().get<PurgeOptions>();
    if (options.after_days <= 0 && options.least_free_gb <= 0)
        throw Error(ErrorCode::wrong_use, "no rule says what to delete", "purge",
                    "set purge.after_days or purge.least_free_gb");
    std::vector<PurgeCandidate> plan = planPurge(store, options, freeGb(store.folder()), nowUtc());
    if (yes)
        for (PurgeCandidate& candidate : plan)
            if (candidate.kept.empty())
                deleteCandidate(store, candidate);
    if (!context.json) {
        print(plan, yes);
        return 0;
    }
    nlohmann::json cases = nlohmann::json::array();
    for (const PurgeCandidate& candidate : plan)
        cases.push_back({{"case", candidate.case_id},
                         {"last_event", candidate.last_event},
                         {"bytes", candidate.size.bytes},
                         {"rule", candidate.rule},
                         {"kept", candidate.kept},
                         {"deleted", yes && candidate.kept.empty()}});
    std::printf("%s\n", nlohmann::json{{"cases", cases}}.dump(2).c_str());
    return 0;
}

}  // namespace

Subcommand purgeCommand()
{
    return {"purge", "Delete cases by the rules of purge.*; without --yes it says which", [](CommandLine& command) {
                auto yes = std::make_shared<bool>(false);
                command.flag("--yes", *yes, "Delete them");
                return [yes](Context& context) { return purge(context, *yes); };
            }};
}

}  // namespace vicon::app
