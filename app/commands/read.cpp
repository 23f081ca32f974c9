#include "../command.h"
#include "../reading_services.h"

namespace vicon::app {

Subcommand readCommand()
{
    return {"read", "The reading room: worklist and viewer", [](CommandLine& command) {
                auto case_id = std::make_shared<std::string>();
                command.option("CASE", *case_id, "Open this case at once");
                return [case_id](Context& context) {
                    const auto services = readingServices(context.existingStore().folder(), context.config());
                    const std::string id = case_id->empty() ? "" : context.existingStore().requireCase(*case_id).id;
                    return viewer::runReadingRoom(services, id, stopRequested());
                };
            }};
}

}  // namespace vicon::app
