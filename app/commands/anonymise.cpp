#include "vicon/ingest/anonymise.h"

#include <cstdio>

#include "../command.h"
#include "../progress_line.h"

namespace vicon::app {
namespace {

int anonymise(Context& context, const std::string& given_id, const std::string& out)
{
    CaseStore& store = context.existingStore();
    ProgressLine progress("anonymise");
    const auto made = ingest::anonymise(store, store.requireCase(given_id).id, out, progress);
    progress.clear();
    if (context.json) {
        std::printf("%s\n", nlohmann::json{{"written", made.written}, {"left_out", made.left_out}}.dump(2).c_str());
        return made.written > 0 ? 0 : 1;
    }
    std::printf("%d objects written\n", made.written);
    for (const auto& [why, count] : made.left_out)
        std::printf("%d left out: %s\n", count, why.c_str());
    return made.written > 0 ? 0 : 1;
}

}  // namespace

Subcommand anonymiseCommand()
{
    return {"anonymise", "Write a case's CT images without who it is (DICOM PS3.15, basic profile)",
            [](CommandLine& command) {
                auto case_id = std::make_shared<std::string>(), out = std::make_shared<std::string>();
                command.option("CASE", *case_id, "The case's id").required();
                command.option("OUT", *out, "A folder that is made").required();
                return [case_id, out](Context& context) { return anonymise(context, *case_id, *out); };
            }};
}

}  // namespace vicon::app
