#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "command_line.h"
#include "vicon/cases/case_store.h"
#include "vicon/cases/roles.h"
#include "vicon/core/options.h"
#include "vicon/core/progress.h"

namespace vicon::app {

/// What every subcommand gets: the common options and what follows from them.
class Context {
public:
    std::string store_folder;              ///< --store
    std::string config_file;               ///< --config
    std::vector<std::string> assignments;  ///< --set
    bool json = false;                     ///< --json

    /// The effective configuration. Throws Error{wrong_use}.
    const Config& config();
    /// Throws Error{bad_input} where whoever runs this does not have a role, and Error{wrong_use}.
    void require(Role role);
    std::filesystem::path storeFolder() const;
    /// Another store from now on, which is in this folder alone: whatever database the configuration names is left be.
    void useStoreOfItsOwn(const std::filesystem::path& folder);
    StorePlace storePlace();
    /// The store, which is made when there is none.
    CaseStore& store();
    /// The store; throws Error{not_found} when there is none.
    CaseStore& existingStore();

private:
    std::filesystem::path userConfig() const;

    std::unique_ptr<Config> config_;
    std::unique_ptr<CaseStore> store_;
    bool store_of_its_own_ = false;
};

/// A row of the command's table: its name, one sentence, and a function that declares its own options and returns what
/// to do.
struct Subcommand {
    const char* name;
    const char* help;
    std::function<std::function<int(Context&)>(CommandLine&)> declare;
};

/// Every option of every room, and the configuration file's place.
Config declaredConfig();

/// Set by SIGINT and SIGTERM; long work asks it.
const std::atomic<bool>& stopRequested();
void catchStopSignals();

/// Tells nobody; cancelled by these signals, so that long work does not hold up a listener's end.
class UntilStopped : public NoProgress {
public:
    bool cancelled() const override { return stopRequested(); }
};

// The subcommands, one file each.
Subcommand importCommand();
Subcommand receiveCommand();
Subcommand queryCommand();
Subcommand retrieveCommand();
Subcommand watchCommand();
Subcommand orderCommand();
Subcommand workCommand();
Subcommand casesCommand();
Subcommand showCommand();
Subcommand markCommand();
Subcommand markersCommand();
Subcommand matchCommand();
Subcommand flyCommand();
Subcommand snapshotCommand();
Subcommand readCommand();  ///< only with the viewer built
Subcommand reportCommand();
Subcommand findingCommand();
Subcommand assessCommand();
Subcommand signCommand();
Subcommand amendCommand();
Subcommand auditCommand();
Subcommand priorsCommand();
Subcommand exportCommand();
Subcommand sendCommand();
Subcommand outboxCommand();
Subcommand deleteCommand();
Subcommand purgeCommand();
Subcommand backupCommand();
Subcommand anonymiseCommand();
Subcommand restoreCommand();
Subcommand phantomCommand();
Subcommand configCommand();
Subcommand doctorCommand();

}  // namespace vicon::app
