#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "../command.h"
#include "../peers.h"
#include "vicon/cases/purge.h"
#include "vicon/cases/store_figures.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/ingest/receiver.h"
#include "vicon/ingest/sender.h"
#include "vicon/ingest/tls.h"
#include "vicon/viewer/scene/display.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

constexpr double kLeastFreeGb = 5;    // a case of two scans takes about 2.5 GB
constexpr double kLeastMemoryGb = 4;  // the pipeline's peak on 512 x 512 x 591 voxels is below 2 GB

struct Check {
    std::string name;
    bool good;
    std::string detail;
};

/// Runs a check; an Error is a finding, not the end.
Check checked(const std::string& name, const std::function<std::string()>& check)
{
    try {
        return {name, true, check()};
    } catch (const std::exception& e) {
        return {name, false, e.what()};
    }
}

std::string formatGb(double gb)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.1f GB", gb);
    return text;
}

std::string checkStore(Context& context)
{
    CaseStore& store = context.store();
    const fs::path probe = store.folder() / ".doctor";
    replaceFile(probe, "probe");
    fs::remove(probe);
    return store.folder().string() + ", schema version " + std::to_string(Database::kSchemaVersion);
}

std::string checkDatabase(Context& context)
{
    if (const std::string damage = context.store().database().damage(); !damage.empty())
        throw Error(ErrorCode::database, "the database is damaged (" + damage.substr(0, damage.find('\n')) + ")",
                    context.store().database().where(), "restore it from a backup");
    return "whole";
}

/// No fault, but nobody else says that it waits for a person.
std::string checkQuarantine(Context& context)
{
    const Quarantine found = quarantineOf(context.store());
    if (found.objects == 0)
        return "empty";
    return std::to_string(found.objects) + " objects since " + found.since + ", in " +
           (context.store().folder() / "quarantine").string() + "; the log says of each why";
}

std::string checkPeer(const Config& config, const std::string& name)
{
    const ingest::Peer peer = requirePeer(config, name);
    ingest::echo(peer, config.get<ingest::ReceiverOptions>().ae_title);
    return ingest::whereIs(peer) + " answers";
}

std::string checkSpace(Context& context)
{
    const double gb = freeGb(context.store());
    if (gb < kLeastFreeGb)
        throw Error(ErrorCode::store, "only " + formatGb(gb) + " free", context.storeFolder().string(),
                    "a case takes about 2.5 GB; make room");
    return formatGb(gb) + " free";
}

std::string checkMemory()
{
    const double gb = double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGE_SIZE)) / 1e9;
    if (gb < kLeastMemoryGb)
        throw Error(ErrorCode::no_memory, "only " + formatGb(gb) + " of memory", {}, "the pipeline wants 4 GB");
    return formatGb(gb);
}

std::string checkDisplay()
{
    const viewer::Display display;
    return display.isPrivate() ? "private Xvfb " + display.name() : display.name();
}

std::string checkCertificates(const ingest::TlsOptions& tls)
{
    constexpr int kSoonDays = 30;
    const auto terms = ingest::certificateTerms(tls);
    const auto first = std::min_element(terms.begin(), terms.end(),
                                        [](const auto& a, const auto& b) { return a.days_left < b.days_left; });
    if (first->days_left < kSoonDays)
        throw Error(
            ErrorCode::wrong_use,
            first->days_left < 0 ? "a certificate ended on " + first->ends : "a certificate ends on " + first->ends,
            first->file, "replace it; 'vicon receive' uses the new one at once");
    return "the first ends on " + first->ends;
}

int doctor(Context& context)
{
    std::vector<Check> checks = {
        checked("configuration", [&] { return std::to_string(context.config().specs().size()) + " options"; }),
        checked("store", [&] { return checkStore(context); }),
        checked("database", [&] { return checkDatabase(context); }),
        checked("quarantine", [&] { return checkQuarantine(context); }),
        checked("disk space", [&] { return checkSpace(context); }),
        checked("memory", [] { return checkMemory(); }),
        checked("display", [] { return checkDisplay(); }),
    };
    for (const auto& [name, about] : context.config().peers().items())
        checks.push_back(checked("peer " + name, [&, &name = name] { return checkPeer(context.config(), name); }));
    if (const auto tls = context.config().get<ingest::TlsOptions>(); !tls.certificate.empty())
        checks.push_back(checked("certificates", [&] { return checkCertificates(tls); }));
    bool all_good = true;
    nlohmann::json list = nlohmann::json::array();
    for (const Check& check : checks) {
        all_good = all_good && check.good;
        list.push_back({{"check", check.name}, {"good", check.good}, {"detail", check.detail}});
        if (!context.json)
            std::printf("%-4s %-14s %s\n", check.good ? "ok" : "BAD", check.name.c_str(), check.detail.c_str());
    }
    if (context.json)
        std::printf("%s\n", nlohmann::json{{"checks", list}}.dump(2).c_str());
    return all_good ? 0 : 1;
}

}  // namespace

Subcommand doctorCommand()
{
    return {"doctor", "Check that everything that VICON needs works here",
            [](CommandLine&) { return [](Context& context) { return doctor(context); }; }};
}

}  // namespace vicon::app
