#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/core/options.h"
#include "vicon/core/progress.h"

namespace vicon::ingest {

/// What import accepts, and how far it repairs. docs/admin/import-rules.md explains each.
struct ImportOptions {
    /// Ten slices are what the design calls the least a scan can have.
    int min_slices = 10;
    /// The smallest polyp that is reported is 6 mm; half of it may hide between two slices that were measured.
    double largest_missing_gap_mm = 3.0;
    /// Positions are written with three decimals or better; tables are positioned to about a tenth of a millimetre.
    double spacing_tolerance_mm = 0.1;
    /// Of all slices of a scan, the part that may be interpolated before it is no longer a measured scan.
    double largest_interpolated_part = 0.1;
    /// Scanners write 512 to 2048 columns; a larger claim in a damaged file must not take all memory.
    int largest_matrix = 8192;
    double largest_volume_mvoxel = 4000;
    /// Objects of one zip file: a study has some thousands.
    int archive_max_files = 100000;
    double archive_max_gb = 32;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("import.min_slices", min_slices, "", "Series with fewer slices are kept, but not queued.", {2, 100000});
        v("import.largest_missing_gap_mm", largest_missing_gap_mm, "mm",
          "Missing slices are interpolated over at most this length; a larger gap refuses the series.", {0, 100});
        v("import.spacing_tolerance_mm", spacing_tolerance_mm, "mm",
          "How far a slice may lie from its place in an even stack.", {0.001, 2});
        v("import.largest_interpolated_part", largest_interpolated_part, "",
          "A series is refused when a larger part of its slices would have to be interpolated.", {0, 1});
        v("import.largest_matrix", largest_matrix, "pixels", "Images with more rows or columns are refused.",
          {16, 65535});
        v("import.largest_volume_mvoxel", largest_volume_mvoxel, "million voxels",
          "Series that would make a larger volume are refused.", {1, 100000});
        v("import.archive_max_files", archive_max_files, "", "A zip file with more entries is refused from there on.",
          {1, 10000000});
        v("import.archive_max_gb", archive_max_gb, "GB", "A zip file is unpacked up to this size in all.",
          {0.001, 1000});
    }
};

/// One thing that import tells: about a series, or about a file.
struct ImportLine {
    enum class Kind {
        stored,       ///< a scan or a kept series was stored, or grew
        unchanged,    ///< it was there already
        kept,         ///< stored and selectable, not queued: another reconstruction, or too few slices
        set_aside,    ///< no slice of CT or MR: localizer, dose sheet, secondary capture, report, another modality
        refused,      ///< cannot be used; the text says why
        quarantined,  ///< the same study UID with another patient
        repaired,     ///< was used, but something had to be mended or assumed
        flagged,      ///< a person must decide about a case
    };
    Kind kind = Kind::stored;
    std::string subject;  ///< the file as it was found, or the Series Instance UID
    std::string text;     ///< without a patient's name
    std::string case_id;  ///< empty when nothing was stored
    std::string scan_id;
};
std::string nameOf(ImportLine::Kind kind);
/// As docs/dev/schemas/import.schema.json has it.
nlohmann::json toJson(const ImportLine& line);

struct ImportReport {
    std::vector<ImportLine> lines;
    int scans_stored = 0;     ///< scans that are new or grew; each was queued
    int scans_unchanged = 0;  ///< scans and kept series that were there already
    int images_kept = 0;      ///< series that were stored without being queued
    int reports = 0;          ///< measurement reports that were stored, or were there already
    int set_aside = 0;        ///< objects
    int refused = 0;          ///< objects, quarantined ones among them
    /// Files that were read and of which the store holds no copy, or may hold none: whoever has to keep them keeps
    /// these. Files out of zip files are not among them.
    std::vector<std::filesystem::path> not_stored;
    /// Whether at least one scan, image or report was stored or was there already: exit code 0.
    bool anythingStored() const { return scans_stored + scans_unchanged + images_kept + reports > 0; }
};

/// Takes files, folders (recursively), DICOMDIRs and zip files into cases. What cannot be used costs a line, never the
/// rest of the import. Killed at any moment and started again, it ends in the same state; so it does when a study or a
/// series arrives in parts. One import works on a store at a time: a second one waits.
/// @param paths as the user gave them
/// @throws Error{not_found} when a path does not exist, Error{store} or Error{database} when the store cannot be read
///         or written, Error{no_memory}, Error{cancelled}; the same again may then succeed
ImportReport importPaths(CaseStore& store, const std::vector<std::filesystem::path>& paths,
                         const ImportOptions& options, Progress& progress);

}  // namespace vicon::ingest
