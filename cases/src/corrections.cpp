#include "vicon/cases/corrections.h"

#include <soci/soci.h>

#include <array>
#include <cstdio>
#include <functional>

#include "case_rows.h"
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

/// Alone with the database: of two readers at once neither takes back what the other said.
void change(CaseStore& store, const QueueOptions& options, const ScanRecord& scan,
            const std::function<Corrections()>& changed)
{
    requireRole(Role::mark);
    const fs::path folder = store.scanFolder(scan.case_id, scan.id);
    requireColon(store, scan);
    store.database().write([&](soci::session& sql) {
        const Corrections all = changed();
        requireInside(folder, all);
        putAudit(sql, AuditEvent::corrections_changed, scan.case_id, scan.id, toJson(all).dump());
        writeCorrections(folder, all);  // last: what is left to fail is the commit
    });
    retryWhereFailed(store, options, scan);
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

void replaceCorrections(CaseStore& store, const QueueOptions& options, const ScanRecord& scan, const Corrections& all,
                        const std::optional<Corrections>& expected)
{
    change(store, options, scan, [&] {
        if (expected && *expected != readCorrections(store.scanFolder(scan.case_id, scan.id)))
            throw Error(ErrorCode::bad_input,
                        "what was corrected in this scan was changed by another reader meanwhile; it is left as it is "
                        "now");
        return all;
    });
}

void addCorrections(CaseStore& store, const QueueOptions& options, const ScanRecord& scan, const Corrections& more)
{
    change(store, options, scan, [&] {
        Corrections all = readCorrections(store.scanFolder(scan.case_id, scan.id));
        for (const Correction kind : kCorrections)
            all.of(kind).insert(all.of(kind).end(), more.of(kind).begin(), more.of(kind).end());
        return all;
    });
}

}  // namespace vicon
