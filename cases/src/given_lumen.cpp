#include "vicon/cases/given_lumen.h"

#include <set>

#include "retry_failed.h"
#include "this_person.h"
#include "vicon/cases/organs.h"
#include "vicon/cases/roles.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/json_text.h"
#include "vicon/scan_files/volume_file.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon {
namespace {

constexpr const char* kLumenFile = "lumen.json";
constexpr std::size_t kShownDigits = 12;

/// Named by its origin, so that one mask never stands where the record of another points to.
std::string maskName(const LumenOrigin& origin)
{
    return "lumen-" + sha256(origin.sha256 + "\n" + std::to_string(origin.label)).substr(0, kShownDigits) + ".mha";
}

/// The masks that no record names: of earlier lumens, or of an import that was killed.
void removeOtherMasks(const fs::path& scan_folder, const fs::path& kept)
{
    std::set<fs::path> others;
    for (const auto& entry : fs::directory_iterator(scan_folder))
        if (const std::string name = entry.path().filename();
            name.starts_with("lumen-") && name.ends_with(".mha") && name != kept)
            others.insert(entry.path());
    std::error_code gone;
    for (const fs::path& other : others)
        fs::remove(other, gone);
}

}  // namespace

json toJson(const LumenOrigin& origin)
{
    return {{"form", origin.form},   {"sha256", origin.sha256},
            {"label", origin.label}, {"gas_or_fluid", origin.gas_or_fluid},
            {"by", origin.by},       {"at", origin.at}};
}

LumenOrigin lumenOriginFromJson(const json& json)
{
    return {json.value("form", ""),          json.value("sha256", ""), wholeNumber(json, "label", 0),
            json.value("gas_or_fluid", 0.0), json.value("by", ""),     json.value("at", "")};
}

std::string textOf(const LumenOrigin& origin)
{
    return origin.form + ", label " + std::to_string(origin.label) + ", SHA-256 " +
           origin.sha256.substr(0, kShownDigits) + "..., given by " + origin.by + " on " + origin.at;
}

std::optional<GivenLumen> readGivenLumen(const fs::path& scan_folder)
{
    const fs::path file = scan_folder / kLumenFile;
    if (!fs::exists(file))
        return std::nullopt;
    try {
        const json said = parsedJson(readFile(file));
        const fs::path mask = said.at("mask").get<std::string>();
        if (mask.has_filename() && mask == mask.filename() && mask != "." && mask != "..")
            return GivenLumen{lumenOriginFromJson(said), scan_folder / mask, said.at("mask_sha256").get<std::string>()};
    } catch (const json::exception&) {
    }
    throw Error(ErrorCode::bad_input, "this does not say where the scan's lumen comes from", file.string(),
                "give the lumen again with 'vicon import --mask CASE SCAN FILE', or 'none' as FILE");
}

void requireTakesLumen(CaseStore& store, const ScanRecord& scan)
{
    if (scan.role != ScanRole::scan)
        throw Error(ErrorCode::wrong_use, "this series is " + nameOf(scan.role) + " and not worked on", scan.id,
                    "give the lumen to the case's scan");
    if (const Organ organ = organOf(store, scan); !organ.isColon())
        throw Error(ErrorCode::wrong_use, "a lumen is given to a colon; this scan shows the " + organ.name(), scan.id,
                    "say that it is a colon with 'vicon work --organ colon --case CASE' first");
}

void giveLumen(CaseStore& store, const QueueOptions& options, const ScanRecord& scan, const InsideVolume& mask,
               LumenOrigin origin)
{
    requireRole(Role::mark);
    requireTakesLumen(store, scan);
    origin.by = thisPerson();
    origin.at = nowUtc();
    const fs::path folder = store.scanFolder(scan.case_id, scan.id), name = maskName(origin);
    scan_files::writeVolume(folder / name, mask, scan_files::Packing::zlib);
    json said = toJson(origin);
    said["mask"] = name.string();
    said["mask_sha256"] = sha256OfFile(folder / name);
    replaceFile(folder / kLumenFile, said.dump(2) + "\n");
    removeOtherMasks(folder, name);
    store.audit(AuditEvent::lumen_given, scan.case_id, scan.id, toJson(origin).dump());
    retryWhereFailed(store, options, scan);
}

bool takeBackLumen(CaseStore& store, const QueueOptions& options, const ScanRecord& scan)
{
    requireRole(Role::mark);
    const fs::path folder = store.scanFolder(scan.case_id, scan.id);
    std::error_code none;
    if (!fs::remove(folder / kLumenFile, none))
        return false;
    flushToDisk(folder);
    removeOtherMasks(folder, {});
    store.audit(AuditEvent::lumen_taken_back, scan.case_id, scan.id, "");
    retryWhereFailed(store, options, scan);
    return true;
}

}  // namespace vicon
