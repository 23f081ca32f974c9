#include <filesystem>

#include "../command.h"
#include "../demo_case.h"
#include "../operation_audit.h"
#include "../reading_services.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

struct ReadArguments {
    std::string case_id;
    bool demo = false;
};

/// Of no patient, and in a store of its own: nothing synthetic comes among patients' cases.
std::string openDemo(Context& context, const ReadArguments& arguments)
{
    if (!arguments.case_id.empty())
        throw Error(ErrorCode::wrong_use, "the synthetic case has a store of its own", "--demo", "leave out CASE");
    viewer::requireScreen();  // told before minutes of work
    const std::filesystem::path usual = context.storeFolder();
    context.useStoreOfItsOwn((usual.has_filename() ? usual : usual.parent_path()).string() + "-demo");
    return demoCase(context);
}

int read(Context& context, const ReadArguments& arguments)
{
    std::string id;
    if (arguments.demo)
        id = openDemo(context, arguments);
    else if (!arguments.case_id.empty())
        id = context.existingStore().requireCase(arguments.case_id).id;
    const AuditedRun audited(context.existingStore().place(), "read");
    return viewer::runReadingRoom(readingServices(context.existingStore().place(), context.config()), id,
                                  stopRequested());
}

}  // namespace

Subcommand readCommand()
{
    return {"read", "The reading room: worklist and viewer", [](CommandLine& command) {
                auto arguments = std::make_shared<ReadArguments>();
                command.option("CASE", arguments->case_id, "Open this case at once");
                command.flag("--demo", arguments->demo,
                             "Open a synthetic case; the first time it is made and prepared (a minute or two), in a "
                             "store of its own beside the usual one");
                return [arguments](Context& context) { return read(context, *arguments); };
            }};
}

}  // namespace vicon::app
