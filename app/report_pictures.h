#pragma once

#include <filesystem>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/core/progress.h"
#include "vicon/report/content.h"

namespace vicon::app {

/// A private folder for a report's pictures, gone when the report is written.
class PictureFolder {
public:
    PictureFolder();
    ~PictureFolder();
    PictureFolder(const PictureFolder&) = delete;
    PictureFolder& operator=(const PictureFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

/// What the report says about each scan, with its overview drawn. A scan that has not been prepared, or holds no colon,
/// is listed without a picture. The overview bears the numbers of the findings, and the ids of markers of none.
/// No picture says whose it is: the page does. Needs a viewer::Display that lives on, or starts one of its own.
std::vector<report::ScanEntry> drawScans(CaseStore& store, const ReadCase& read, const PictureFolder& pictures,
                                         Progress& progress);

/// What it says about each marker, in order of scan and station, with the endoscopic and the slice picture drawn.
std::vector<report::MarkerEntry> drawMarkers(CaseStore& store, const ReadCase& read,
                                             const std::vector<report::ScanEntry>& scans, const PictureFolder& pictures,
                                             Progress& progress);

}  // namespace vicon::app
