#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/cases/report_versions.h"
#include "vicon/core/options.h"
#include "vicon/core/progress.h"

namespace vicon::app {

struct WrittenReport {
    std::filesystem::path file;
    int number = 0;
    int pages = 0;
    std::size_t markers = 0;
    std::vector<std::string> warnings;
};

/// Draws and writes a case's report as PDF; `out` empty: into the case's folder, under its number.
WrittenReport writeReport(CaseStore& store, const Config& config, const std::string& case_id,
                          const std::filesystem::path& out, Progress& progress);
/// The PDF that writeReport() would write now: it takes no number and counts as no report.
std::string previewReport(CaseStore& store, const Config& config, const std::string& case_id, Progress& progress);

struct GivenReport {
    ReportVersion version;
    int pages = 0;
    std::vector<std::string> warnings;
};

/// Draws a case's report and keeps it as a version: signed, or preliminary. Throws as draftVersion() and keepVersion()
/// do, and Error{store} where a picture of it cannot be read: nothing was kept then.
GivenReport giveOutReport(CaseStore& store, const Config& config, const std::string& case_id, bool sign,
                          Progress& progress);

}  // namespace vicon::app
