#include "configuration.h"

#include "command.h"
#include "vicon/core/error.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

constexpr std::string_view kRoles = "roles.";

void requireRolesOf(const fs::path& system, const Config& config)
{
    for (const OptionSpec& spec : config.specs())
        if (const std::string& source = config.at(spec.key).source;
            spec.key.starts_with(kRoles) && source != "default" && !source.starts_with(system.string()))
            throw Error(ErrorCode::wrong_use, "roles are given by " + system.string() + " alone",
                        spec.key + " (" + source + ")", "take it out there");
}

}  // namespace

Config readConfig(const ConfigSources& sources)
{
    Config config = declaredConfig();
    for (const fs::path& file : {sources.system, sources.user})
        if (fs::exists(file))
            config.readFile(file);
    for (const std::string& assignment : sources.assignments)
        config.set(assignment);
    if (fs::exists(sources.system))
        requireRolesOf(sources.system, config);
    return config;
}

}  // namespace vicon::app
