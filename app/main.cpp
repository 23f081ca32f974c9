#include <malloc.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <new>
#include <optional>
#include <string_view>
#include <thread>

#include "command.h"
#include "log_lines.h"
#include "standard_streams.h"
#include "vicon/cases/roles.h"
#include "vicon/core/error.h"
#include "vicon/core/printable.h"
#include "wrong_words.h"

namespace vicon::app {
namespace {

constexpr int kFailed = 1, kWrongUse = 2;
constexpr const char* kCommonFooter =
    "Also, before or after the subcommand: --store DIR, --config FILE, --set KEY=VALUE, --json; see 'vicon --help'.";

std::vector<Subcommand> subcommands()
{
    std::vector<Subcommand> rows{
        importCommand(), receiveCommand(), queryCommand(),   retrieveCommand(), workCommand(),      casesCommand(),
        showCommand(),   markCommand(),    markersCommand(), matchCommand(),    flyCommand(),       snapshotCommand(),
        reportCommand(), findingCommand(), assessCommand(),  signCommand(),     amendCommand(),     auditCommand(),
        exportCommand(), priorsCommand(),  sendCommand(),    outboxCommand(),   watchCommand(),     orderCommand(),
        deleteCommand(), purgeCommand(),   backupCommand(),  restoreCommand(),  anonymiseCommand(), phantomCommand(),
        configCommand(), doctorCommand()};
#ifdef VICON_HAS_VIEWER
    rows.push_back(readCommand());
#endif
    return rows;
}

/// What a subcommand takes; nothing: anybody may. What is not listed takes who operates VICON.
std::optional<Role> roleFor(std::string_view subcommand)
{
    constexpr std::string_view kReading[] = {"cases",  "show",  "markers", "match", "fly",    "snapshot", "read",
                                             "report", "audit", "export",  "query", "priors", "finding",  "assess"};
    constexpr std::string_view kMarking[] = {"mark", "sign", "amend"};
    constexpr std::string_view kAnybody[] = {"config", "doctor", "phantom"};
    const auto has = [&](const auto& names) {
        return std::find(std::begin(names), std::end(names), subcommand) != std::end(names);
    };
    if (has(kAnybody))
        return {};
    return has(kReading) ? Role::read : has(kMarking) ? Role::mark : Role::operate;
}

/// Memory that was given back is kept for what asks next, in a heap for each core: threads that come and go would have
/// up to eight for each, and pages brought in anew were a sixth of the time that a signature with ten findings takes.
/// What is larger than a picture goes back to the system at once, as before.
void keepMemoryForReuse()
{
    constexpr int kPicture = 32 << 20, kKeptOfAHeap = 64 << 20;
    ::mallopt(M_ARENA_MAX, int(std::max(1U, std::thread::hardware_concurrency())));
    ::mallopt(M_MMAP_THRESHOLD, kPicture);
    ::mallopt(M_TRIM_THRESHOLD, kKeptOfAHeap);
}

/// A variable that is not set must not mean the usual place.
std::string whyNoName(const std::string& given)
{
    return given.empty() ? "is empty; name a place, or leave the option out" : "";
}

void addCommonOptions(CLI::App& command, Context& context)
{
    const CLI::Validator named(whyNoName, "");
    command
        .add_option("--store", context.store_folder,
                    "Folder of the store (default: $VICON_STORE, else ~/.local/share/vicon)")
        ->type_name("DIR")
        ->check(named);
    command
        .add_option("--config", context.config_file,
                    "Configuration file (default: ~/.config/vicon/config.toml, if there)")
        ->type_name("FILE")
        ->check(named);
    command.add_option("--set", context.assignments, "Set one option of the configuration; 'vicon config' lists them")
        ->type_name("KEY=VALUE");
    command.add_flag("--json", context.json, "Print JSON instead of text");
}

int fail(const std::string& line, int exit_code)
{
    std::fprintf(stderr, "vicon: %s\n", printable(line).c_str());
    return exit_code;
}

int run(int argc, char** argv)
{
    Context context;
    CLI::App command("VICON: virtual colonoscopy, from a CT series to a report.", "vicon");
    command.set_version_flag("--version", "vicon " VICON_VERSION);
    command.require_subcommand(1);
    command.fallthrough();
    addCommonOptions(command, context);
    command.footer("'vicon SUBCOMMAND --help' tells more. Research software; no medical device.");
    std::function<int(Context&)> chosen;
    for (const Subcommand& row : subcommands()) {
        CLI::App* sub = command.add_subcommand(row.name, row.help);
        sub->fallthrough();
        sub->footer(kCommonFooter);
        CommandLine line(*sub);
        sub->final_callback([&chosen, action = row.declare(line), role = roleFor(row.name)] {
            chosen = [action, role](Context& given) {
                if (role)
                    given.require(*role);
                return action(given);
            };
        });
    }
    try {
        command.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        const std::string wrong = wrongWordsOf(command, e);
        return wrong.empty() ? command.exit(e) : fail(wrong, kWrongUse);
    }
    return chosen(context);
}

/// Whatever goes wrong is one line.
int runOrTell(int argc, char** argv)
try {
    return run(argc, argv);
} catch (const Error& e) {
    return fail(e.what(), e.code() == ErrorCode::wrong_use ? kWrongUse : kFailed);
} catch (const std::bad_alloc&) {
    return fail("not enough memory; close other programs and try again", kFailed);
} catch (const std::filesystem::filesystem_error& e) {
    return fail(e.path1().string() + ": cannot be used (" + e.code().message() +
                    "); check that the path is right and that this user may use it",
                kFailed);
} catch (const std::exception& e) {
    return fail(e.what(), kFailed);
}

}  // namespace
}  // namespace vicon::app

int main(int argc, char** argv)
{
    using namespace vicon;
    app::keepMemoryForReuse();
    app::openStandardStreams();
    spdlog::set_default_logger(spdlog::stderr_logger_mt("vicon"));
    app::writeLogAs({});
    app::catchStopSignals();
    const int exit_code = app::runOrTell(argc, argv);
    const std::string lost = app::whyNotPrinted();
    return lost.empty() ? exit_code : app::fail(lost, exit_code == 0 ? app::kFailed : exit_code);
}
