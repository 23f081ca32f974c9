#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/bridges.h"
#include "vicon/cases/marker.h"
#include "vicon/cases/records.h"
#include "vicon/cases/report_content.h"
#include "vicon/cases/report_versions.h"
#include "vicon/core/scan_quality.h"
#include "vicon/core/verdict.h"

namespace vicon::report {

/// A scan of the case and what the pipeline found out about it.
struct ScanEntry {
    ScanRecord scan;
    double skeleton_length_mm = 0;           ///< rectal end to caecal end, bridges included; 0: not prepared
    std::optional<Verdict> verdict;          ///< of the segmentation; absent: not prepared
    std::string organ_title;                 ///< what it was of: "colon"
    std::string reason;                      ///< why this verdict and confidence; may be empty
    double confidence = 0;                   ///< 0 to 1
    std::string lumen_given;                 ///< where the lumen came from; empty: VICON found it
    std::vector<ReviewedBridge> bridges;     ///< from the rectum
    ColonPartRanges parts;                   ///< empty: not known
    std::optional<ScanQuality> quality;      ///< absent: not measured
    std::filesystem::path overview_picture;  ///< PNG, or its name among PrintPictures; empty: none was made
};

/// A marker, with the names and pictures that its entry shows; pictures as those of scans.
struct MarkerEntry {
    Marker marker;
    std::string scan_label;  ///< as a reader calls the scan: "supine (series 3)"
    std::string part_name;   ///< of the colon: "sigmoid", ...; empty: not known
    std::filesystem::path endoscopic_picture;
    std::string seen_from;                ///< of the endoscopic picture: "towards head, 28 mm away"
    std::filesystem::path below_picture;  ///< below the wall; empty: none was made
    std::filesystem::path slices_picture;
    std::filesystem::path measures_picture;  ///< best plane and histogram; empty: nothing was measured so
};

/// All that a report says. Patient, study, series and markers are the case's own records, never typed in anew; what an
/// encapsulated PDF or a structured report needs (UIDs, frames of reference, positions in LPS mm) is in them.
struct ReportContent {
    ReadCase read;  ///< the case, its findings and what was said of the whole study
    std::vector<ScanEntry> scans;
    std::vector<MarkerEntry> markers;      ///< all, also those that belong to a finding
    std::string created;                   ///< UTC, "2026-11-21T08:15:30Z"
    int number = 1;                        ///< of the report within its case
    std::optional<ReportVersion> version;  ///< that is given out; absent: this is a draft
    std::string software_version;
};

}  // namespace vicon::report
