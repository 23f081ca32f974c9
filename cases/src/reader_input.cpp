#include "vicon/cases/reader_input.h"

#include <soci/soci.h>

#include "bridge_reviews_file.h"
#include "vicon/cases/corrections.h"
#include "vicon/cases/given_lumen.h"
#include "vicon/cases/report_files.h"
#include "vicon/core/error.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

/// A file that cannot be understood says something that is not known: true.
bool isCorrected(const fs::path& scan_folder)
try {
    return !readCorrections(scan_folder).empty();
} catch (const Error&) {
    return true;
}

bool isReviewed(const fs::path& scan_folder)
try {
    return !readBridgeReviews(scan_folder).empty();
} catch (const Error&) {
    return true;
}

bool hasGivenLumen(const fs::path& scan_folder)
try {
    return readGivenLumen(scan_folder).has_value();
} catch (const Error&) {
    return true;
}

bool hasMarkers(CaseStore& store, const ScanRecord& scan)
{
    int markers = 0;
    store.database().session() << "SELECT COUNT(*) FROM markers WHERE case_id = :c AND scan_id = :s",
        soci::use(scan.case_id), soci::use(scan.id), soci::into(markers);
    return markers > 0;
}

bool hasReport(CaseStore& store, const std::string& case_id)
{
    return !countReports(store, {CaseRecord{.id = case_id}}).empty();
}

}  // namespace

bool hasReaderInput(CaseStore& store, const ScanRecord& scan)
{
    const fs::path folder = store.scanFolder(scan.case_id, scan.id);
    return hasMarkers(store, scan) || isCorrected(folder) || isReviewed(folder) || hasGivenLumen(folder) ||
           (scan.role == ScanRole::scan && hasReport(store, scan.case_id));
}

}  // namespace vicon
