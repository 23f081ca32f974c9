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

/// Whether there is one. One that may not be looked at is not taken for none: what it sets would be left out in
/// silence.
bool isThere(const fs::path& file, const std::string& remedy)
{
    std::error_code failure;
    const bool there = fs::exists(file, failure);
    if (failure)
        throw Error(ErrorCode::wrong_use, "the configuration cannot be looked at (" + failure.message() + ")",
                    file.string(), remedy);
    return there;
}

}  // namespace

Config readConfig(const ConfigSources& sources)
{
    Config config = declaredConfig();
    const bool has_system = isThere(sources.system, "let this user read it");
    if (has_system)
        config.readFile(sources.system);
    if (isThere(sources.user, "let this user read it, or name another with --config"))
        config.readFile(sources.user);
    for (const std::string& assignment : sources.assignments)
        config.set(assignment);
    if (has_system)
        requireRolesOf(sources.system, config);
    return config;
}

}  // namespace vicon::app
