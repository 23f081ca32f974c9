#include "vicon/cases/corrections.h"

#include <array>
#include <cstdio>

#include "retry_failed.h"
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

constexpr const char* kCorrectionsFile = "corrections.json";

void requireInside(const fs::path& scan_folder, const Corrections& corrections)
{
    const fs::path file = scan_folder / "volume.mha";
    if (corrections.empty() || !fs::exists(file))
        return;
    const Grid grid = scan_files::readGrid(file);
    for (const Correction kind : kCorrections)
        for (const Point3 p : corrections.of(kind)) {
            if (grid.contains(grid.indexAt(p)))
                continue;
            std::array<char, 96> text{};
            std::snprintf(text.data(), text.size(), "the point %.1f,%.1f,%.1f lies outside the scan", p.x, p.y, p.z);
            throw Error(ErrorCode::wrong_use, text.data(), "--" + nameOf(kind),
                        "give LPS mm, as 'vicon snapshot --view slices' shows them");
        }
}

void requireColon(CaseStore& store, const ScanRecord& scan)
{
    if (const Organ organ = organOf(store, scan); !organ.isColon())
        throw Error(ErrorCode::wrong_use, "corrections are made to a colon; this scan shows the " + organ.name(),
                    scan.id, "set organ.seed to a point inside it instead");
}

}  // namespace

Corrections readCorrections(const fs::path& scan_folder)
{
    const fs::path file = scan_folder / kCorrectionsFile;
    if (!fs::exists(file))
        return {};
    try {
        return correctionsFromJson(parsedJson(readFile(file)));
    } catch (const json::exception&) {
        throw Error(ErrorCode::bad_input, "these corrections cannot be understood", file.string(),
                    "take them back with 'vicon work --case CASE --forget-corrections'");
    }
}

void writeCorrections(const fs::path& scan_folder, const Corrections& corrections)
{
    const fs::path file = scan_folder / kCorrectionsFile;
    if (corrections.empty()) {
        std::error_code missing;
        fs::remove(file, missing);
        return;
    }
    replaceFile(file, toJson(corrections).dump(2) + "\n");
}

void replaceCorrections(CaseStore& store, const QueueOptions& options, const ScanRecord& scan, const Corrections& all)
{
    requireRole(Role::mark);
    const fs::path folder = store.scanFolder(scan.case_id, scan.id);
    requireColon(store, scan);
    requireInside(folder, all);
    writeCorrections(folder, all);
    store.audit(AuditEvent::corrections_changed, scan.case_id, scan.id, toJson(all).dump());
    retryWhereFailed(store, options, scan);
}

void addCorrections(CaseStore& store, const QueueOptions& options, const ScanRecord& scan, const Corrections& more)
{
    Corrections all = readCorrections(store.scanFolder(scan.case_id, scan.id));
    for (const Correction kind : kCorrections)
        all.of(kind).insert(all.of(kind).end(), more.of(kind).begin(), more.of(kind).end());
    replaceCorrections(store, options, scan, all);
}

}  // namespace vicon
