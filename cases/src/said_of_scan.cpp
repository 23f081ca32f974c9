#include "vicon/cases/said_of_scan.h"

#include <soci/soci.h>

#include <algorithm>

#include "vicon/core/file.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon {
namespace {

/// What people say about a scan lies in these files of its folder, each an object of lists.
constexpr const char* kSaidInFiles[] = {"corrections.json", "bridge_reviews.json"};

/// A file that cannot be understood says something that is not known: true.
bool saysSomething(const fs::path& file)
{
    if (!fs::exists(file))
        return false;
    const json content = json::parse(readFile(file), nullptr, false);
    if (!content.is_object())
        return true;
    return std::any_of(content.begin(), content.end(), [](const json& list) { return !list.empty(); });
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
    int reports = 0;
    store.database().session() << "SELECT COUNT(*) FROM audit WHERE event = 'report written' AND case_id = :c",
        soci::use(case_id), soci::into(reports);
    return reports > 0;
}

}  // namespace

bool isSpokenOf(CaseStore& store, const ScanRecord& scan)
{
    const fs::path folder = store.scanFolder(scan.case_id, scan.id);
    return hasMarkers(store, scan) ||
           std::any_of(std::begin(kSaidInFiles), std::end(kSaidInFiles),
                       [&](const char* file) { return saysSomething(folder / file); }) ||
           (scan.role == "scan" && hasReport(store, scan.case_id));
}

}  // namespace vicon
