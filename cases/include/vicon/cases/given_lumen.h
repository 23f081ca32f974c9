#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "vicon/cases/case_store.h"
#include "vicon/cases/job_queue.h"
#include "vicon/core/volume.h"

namespace vicon {

/// Where a lumen came from that another program made.
struct LumenOrigin {
    std::string form;         ///< "NIfTI"
    std::string sha256;       ///< of its file
    int label = 0;            ///< whose voxels these are
    double gas_or_fluid = 0;  ///< share of it that is, by the scan's densities
    std::string by, at;       ///< who gave it, and when (UTC)
};
nlohmann::json toJson(const LumenOrigin& origin);
/// What is missing keeps its default.
LumenOrigin lumenOriginFromJson(const nlohmann::json& json);
/// "NIfTI, label 2, SHA-256 0123456789ab, given by ... on ...", for a person.
std::string textOf(const LumenOrigin& origin);

/// The lumen that a person gave a scan instead of the one that VICON finds.
struct GivenLumen {
    LumenOrigin origin;
    std::filesystem::path mask_file;  ///< of voxels 0 and 1, on a lattice of its own
    std::string mask_sha256;
};

/// The scan's `lumen.json`; nothing when there is no such file. Throws Error{bad_input} when it cannot be understood.
std::optional<GivenLumen> readGivenLumen(const std::filesystem::path& scan_folder);

/// Keeps a mask as the scan's lumen; the file that names it comes last, so that a crash leaves the lumen from before or
/// this one. Puts the scan's job back where it failed. Fills in `by` and `at`. Throws Error{wrong_use} for a scan that
/// is not worked on or shows no colon, Error{store}.
void giveLumen(CaseStore& store, const QueueOptions& options, const ScanRecord& scan, const InsideVolume& mask,
               LumenOrigin origin);
/// VICON finds the lumen itself again. Returns false when it did already.
bool takeBackLumen(CaseStore& store, const QueueOptions& options, const ScanRecord& scan);

/// Throws Error{wrong_use} for a scan that no lumen can be given to: one that is not worked on, or shows no colon.
void requireTakesLumen(CaseStore& store, const ScanRecord& scan);

}  // namespace vicon
