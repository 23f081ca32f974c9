#include <csignal>
#include <cstdlib>

#include "command.h"
#include "configuration.h"
#include "log_lines.h"
#include "operation_audit.h"
#include "store_disk.h"
#include "vicon/cases/case_deletion.h"
#include "vicon/core/error.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

std::atomic<bool> stop_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free, "it is set in a signal handler");

/// A folder of the user's own; empty where nothing says where his home is.
fs::path homeFolder(const char* variable, const char* below_home)
{
    if (const char* folder = std::getenv(variable); folder && *folder)
        return folder;
    const char* home = std::getenv("HOME");
    return home && *home ? fs::path(home) / below_home : fs::path();
}

/// Does not wait for another program that is at it, or that imports.
void finishDeletionsNow(CaseStore& store)
{
    class Impatient : public NoProgress {
    public:
        bool cancelled() const override { return true; }
    } impatient;
    try {
        if (hasBegunDeletions(store))
            finishDeletions(store, StoreLock(store.folder(), impatient));
    } catch (const Error& e) {
        if (e.code() != ErrorCode::cancelled)
            throw;
    }
}

/// Nothing where nothing says where the store is.
std::function<void(const std::string&)> refusalsInto(Context& context)
try {
    return [place = context.storePlace()](const std::string& what) { auditRefusedAccount(place, what); };
} catch (const Error&) {
    return {};
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
    const fs::path data = homeFolder("XDG_DATA_HOME", ".local/share");
    if (data.empty())
        throw Error(ErrorCode::wrong_use, "nothing says where the store is: HOME is not set", {},
                    "name its folder with --store");
    return data / "vicon";
}

const Config& Context::config()
{
    if (config_)
        return *config_;
    config_ = std::make_unique<Config>(readConfig({kSystemConfig, userConfig(), assignments}));
    writeLogAs(config_->get<LogOptions>());
    setRoles(config_->get<RoleOptions>(), refusalsInto(*this));
    return *config_;
}

/// Empty where there can be none.
fs::path Context::userConfig() const
{
    if (config_file.empty()) {
        const fs::path folder = homeFolder("XDG_CONFIG_HOME", ".config");
        return folder.empty() ? folder : folder / "vicon" / "config.toml";
    }
    if (std::error_code failure; fs::status(config_file, failure).type() == fs::file_type::not_found)
        throw Error(ErrorCode::wrong_use, "no such configuration file", config_file);
    return config_file;
}

StorePlace Context::storePlace()
{
    return {storeFolder(), store_of_its_own_ ? "" : config().get<StoreOptions>().database};
}

void Context::useStoreOfItsOwn(const fs::path& folder)
{
    store_.reset();
    store_folder = folder.string();
    store_of_its_own_ = true;
}

void Context::require(Role role)
{
    config();
    requireRole(role);
    config_.reset();  // the command may have more to set
}

CaseStore& Context::store()
{
    config();  // a wrong configuration is told before anything is made
    if (!store_) {
        store_ = std::make_unique<CaseStore>(storePlace());
        finishDeletionsNow(*store_);
    }
    return *store_;
}

CaseStore& Context::existingStore()
{
    requireStore(storeFolder());
    return store();
}

}  // namespace vicon::app
