#include <csignal>
#include <cstdlib>

#include "command.h"
#include "vicon/core/error.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

std::atomic<bool> stop_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free, "it is set in a signal handler");

fs::path homeFolder(const char* variable, const char* below_home)
{
    if (const char* folder = std::getenv(variable); folder && *folder)
        return folder;
    const char* home = std::getenv("HOME");
    return fs::path(home && *home ? home : ".") / below_home;
}

}  // namespace

const std::atomic<bool>& stopRequested()
{
    return stop_requested;
}

void catchStopSignals()
{
    const auto handler = [](int) {
        if (stop_requested.exchange(true))
            std::_Exit(130);  // asked twice: at once
    };
    std::signal(SIGINT, handler);
    std::signal(SIGTERM, handler);
    std::signal(SIGPIPE, SIG_IGN);
}

fs::path Context::storeFolder() const
{
    if (!store_folder.empty())
        return store_folder;
    if (const char* folder = std::getenv("VICON_STORE"); folder && *folder)
        return folder;
    return homeFolder("XDG_DATA_HOME", ".local/share") / "vicon";
}

const Config& Context::config()
{
    if (config_)
        return *config_;
    auto config = std::make_unique<Config>(declaredConfig());
    const fs::path usual = homeFolder("XDG_CONFIG_HOME", ".config") / "vicon" / "config.toml";
    if (!config_file.empty() && !fs::exists(config_file))
        throw Error(ErrorCode::wrong_use, "no such configuration file", config_file);
    if (!config_file.empty())
        config->readFile(config_file);
    else if (fs::exists(usual))
        config->readFile(usual);
    for (const std::string& assignment : assignments)
        config->set(assignment);
    config_ = std::move(config);
    return *config_;
}

CaseStore& Context::store()
{
    config();  // a wrong configuration is told before anything is made
    if (!store_)
        store_ = std::make_unique<CaseStore>(storeFolder());
    return *store_;
}

CaseStore& Context::existingStore()
{
    if (!fs::exists(storeFolder() / "vicon.db"))
        throw Error(ErrorCode::not_found, "there is no store here", storeFolder().string(),
                    "'vicon import' makes one; --store names another folder");
    return store();
}

}  // namespace vicon::app
