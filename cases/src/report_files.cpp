#include "vicon/cases/report_files.h"

#include "vicon/cases/organs.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon {

fs::path reportFolder(const CaseStore& store, const std::string& case_id)
{
    return store.caseFolder(case_id) / "report";
}

std::string versionName(int version)
{
    return "version-" + std::to_string(version) + ".pdf";
}

std::vector<fs::path> versionObjects(const CaseStore& store, const std::string& case_id, int version)
{
    const std::string prefix = "version-" + std::to_string(version) + "-";
    std::vector<fs::path> files;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(reportFolder(store, case_id), none))
        if (entry.path().filename().string().starts_with(prefix) && entry.path().extension() == ".dcm")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

fs::path reportFile(CaseStore& store, const std::string& case_id, int number)
{
    const fs::path folder = reportFolder(store, case_id);
    makePrivateFolder(folder);
    return folder / (std::to_string(number) + ".pdf");
}

int countReports(const CaseStore& store, const std::string& case_id)
{
    std::error_code none;
    int count = 0;
    for (const auto& entry : fs::directory_iterator(reportFolder(store, case_id), none))
        count += entry.path().extension() == ".pdf" ? 1 : 0;
    return count;
}

void requireReportable(CaseStore& store, const CaseRecord& record)
{
    std::string others;
    for (const ScanRecord& scan : store.scans(record.id)) {
        if (scan.role != ScanRole::scan)
            continue;
        const Organ organ = organOf(store, scan);
        if (organ.isColon())
            return;
        others += (others.empty() ? "" : ", ") + organ.name();
    }
    if (!others.empty())
        throw Error(ErrorCode::unusable_scan, "a report tells of a colon; the scans of this case show the " + others,
                    record.id, "'vicon show', 'vicon fly' and 'vicon snapshot' work on them");
}

}  // namespace vicon
