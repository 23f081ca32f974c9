#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report_scans.h"
#include "vicon/cases/case_store.h"
#include "vicon/core/progress.h"
#include "vicon/picture/png_file.h"
#include "vicon/report/content.h"

namespace vicon::app {

/// Told of a picture, by the name that the content has for it, as soon as it is drawn; of a marker's, from left to
/// right, once they all are. Called on several threads.
struct PicturesMade {
    std::function<void(const std::string& name, const picture::SharedPicture&)> picture;
    std::function<void(const std::string& marker_id, std::vector<picture::SharedPicture>)> marker;
};

/// How deep below the wall a marker is looked at: 2 mm, and no deeper than halfway to the middle of its finding.
double depthBelow_mm(const ReadCase& read, const std::string& marker_id);

/// What the report says about each scan, with its overview drawn. A scan that has not been prepared, or holds no colon,
/// is listed without a picture. The overview bears the numbers of the findings, and the ids of markers of none.
/// No picture says whose it is: the page does. Needs a viewer::Display that lives on, or starts one of its own.
std::vector<report::ScanEntry> drawScans(CaseStore& store, const ReadCase& read, ReportScans& scans, Progress& progress,
                                         const PicturesMade& made);

/// What it says about each marker, in order of scan and station, with the endoscopic and the slice picture drawn.
std::vector<report::MarkerEntry> drawMarkers(CaseStore& store, const ReadCase& read,
                                             const std::vector<report::ScanEntry>& entries_of_scans, ReportScans& scans,
                                             Progress& progress, const PicturesMade& made);

}  // namespace vicon::app
