#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>

#include "../command.h"
#include "../named_options.h"
#include "../peers.h"
#include "../store_disk.h"
#include "vicon/cases/purge.h"
#include "vicon/cases/store_figures.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/ingest/receiver.h"
#include "vicon/ingest/sender.h"
#include "vicon/ingest/tls.h"
#include "vicon/report/options.h"
#include "vicon/text/font_set.h"
#include "vicon/viewer/scene/display.h"
#include "vicon/viewer/scene/opengl_renderer.h"

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

/// The folder alone: the database has its own line.
std::string checkFolder(const fs::path& folder, bool on_server)
{
    requireStore(folder);  // a check makes none
    tryFolder(folder);
    const FileSystem disk = fileSystemOf(folder);
    if (const std::string why = whyNoStoreOn(disk, on_server); !why.empty())
        throw Error(ErrorCode::store, why, folder.string(), "see 'Several machines' in docs/admin/operate.md");
    return folder.string() + ", " + disk.name + ", flush and hard links work" +
           (disk.kind == FileSystem::Kind::memory ? "; in memory: gone when the machine stops" : "");
}

std::string checkDatabase(Context& context)
{
    Database& database = context.existingStore().database();
    if (const std::string damage = database.damage(); !damage.empty())
        throw Error(ErrorCode::database, "the database is damaged (" + damage.substr(0, damage.find('\n')) + ")",
                    database.where(), "restore it from a backup");
    return "whole, schema version " + std::to_string(Database::kSchemaVersion);
}

/// No fault, but nobody else says that it waits for a person.
std::string checkQuarantine(const fs::path& store)
{
    std::error_code trouble;
    const fs::directory_iterator looked(store / "quarantine", trouble);
    if (trouble && trouble != std::errc::no_such_file_or_directory)
        throw Error(ErrorCode::store, "it cannot be looked at (" + trouble.message() + ")",
                    (store / "quarantine").string(), "work as the account that the store belongs to");
    const Quarantine found = quarantineOf(store);
    if (found.objects == 0)
        return "empty";
    return std::to_string(found.objects) + " objects since " + found.since + ", in " + (store / "quarantine").string() +
           "; the log says of each why";
}

std::string checkPeer(const Config& config, const std::string& name)
{
    const ingest::Peer peer = requirePeer(config, name);
    if (!peer.is_queried && !peer.is_sent)
        return ingest::whereIs(peer) + " only stores here, and is not called";
    ingest::echo(peer, config.get<ingest::ReceiverOptions>().ae_title);
    return ingest::whereIs(peer) + " answers";
}

std::string checkSpace(const fs::path& folder)
{
    const double gb = freeGb(folder);
    if (gb < kLeastFreeGb)
        throw Error(ErrorCode::store, "only " + formatGb(gb) + " free", folder.string(),
                    "a case takes about 2.5 GB; make room");
    return formatGb(gb) + " free";
}

/// Names are written in every script whose fonts are installed.
std::string checkFonts(const std::string& folder)
{
    constexpr std::pair<char32_t, const char*> kScripts[] = {
        {U'A', "Latin"},    {U'Ω', "Greek"},     {U'Ж', "Cyrillic"}, {U'א', "Hebrew"}, {U'ع', "Arabic"},
        {U'中', "Chinese"}, {U'あ', "Japanese"}, {U'한', "Korean"},  {U'ก', "Thai"},   {U'अ', "Devanagari"}};
    text::FontSet fonts({folder}, text::FontSet::Medium::paper);
    std::string found, missing;
    for (const auto& [letter, script] : kScripts) {
        std::string& list = fonts.find(letter) ? found : missing;
        list += (list.empty() ? "" : ", ") + std::string(script);
    }
    if (!fonts.find(kScripts[0].first))
        throw Error(ErrorCode::bad_input, "no font has Latin letters", folder,
                    "install the Debian package 'fonts-dejavu', or set report.font_folder");
    return found + (missing.empty() ? "" : "; none for " + missing);
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
    const std::string renderer = viewer::openGlRenderer(display);
    return (display.isPrivate() ? "private Xvfb " : "") + display.name() + ", drawn " +
           (viewer::drawsInSoftware(renderer) ? "in software by " : "by ") + renderer;
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

/// A line for each option that names what is not there.
std::vector<Check> checkConfiguration(const Config& config)
{
    std::vector<Check> checks{{"configuration", true, std::to_string(config.specs().size()) + " options"}};
    for (const NamedOption& one : namedOptions())
        if (const Check check = checked(one.option, [&] { return one.require(config), std::string(); }); !check.good)
            checks.push_back(check);
    return checks;
}

/// Of a place where none is, only that.
std::vector<Check> checkStore(Context& context)
{
    const StorePlace place = context.storePlace();
    std::vector<Check> checks{checked("store", [&] { return checkFolder(place.folder, !place.database.empty()); })};
    if (!checked("", [&] { return requireStore(place), std::string(); }).good)
        return checks;
    checks.push_back(checked("database", [&] { return checkDatabase(context); }));
    checks.push_back(checked("quarantine", [&] { return checkQuarantine(place.folder); }));
    checks.push_back(checked("disk space", [&] { return checkSpace(place.folder); }));
    return checks;
}

std::vector<Check> checkMachine(const Config& config)
{
    const auto report = config.get<report::ReportOptions>();
    std::vector<Check> checks = {
        checked("memory", [] { return checkMemory(); }),
        checked("fonts", [&] { return checkFonts(report.font_folder); }),
        checked("display", [] { return checkDisplay(); }),
    };
    for (const auto& [name, about] : config.peers().items())
        checks.push_back(checked("peer " + name, [&, &name = name] { return checkPeer(config, name); }));
    if (const auto tls = config.get<ingest::TlsOptions>(); !tls.certificate.empty())
        checks.push_back(checked("certificates", [&] { return checkCertificates(tls); }));
    return checks;
}

int doctor(Context& context)
{
    std::vector<Check> checks = checkConfiguration(context.config());
    std::ranges::move(checkStore(context), std::back_inserter(checks));
    std::ranges::move(checkMachine(context.config()), std::back_inserter(checks));
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
