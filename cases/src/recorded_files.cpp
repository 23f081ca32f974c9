#include "recorded_files.h"

#include <soci/soci.h>

#include <functional>

#include "vicon/cases/kept_reports.h"
#include "vicon/cases/report_versions.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

struct RecordedFile {
    fs::path file;
    std::string sha256;
};

std::vector<RecordedFile> recordedIn(CaseStore& store, const std::string& statement, const fs::path& folder,
                                     const std::string& case_id)
{
    return store.database().read([&](soci::session& sql) {
        std::vector<RecordedFile> files;
        const soci::rowset<soci::row> rows = (sql.prepare << statement, soci::use(case_id));
        for (const soci::row& row : rows)
            files.push_back({folder / row.get<std::string>(0) / row.get<std::string>(1), row.get<std::string>(2)});
        return files;
    });
}

/// Of a case, or the reports kept of patients ("").
std::vector<RecordedFile> recordedFiles(CaseStore& store, const std::string& case_id)
{
    if (case_id.empty())
        return recordedIn(store, "SELECT '', file, sha256 FROM kept_reports WHERE sop_uid <> :none ORDER BY file",
                          keptReportsFolder(store), case_id);
    auto files = recordedIn(store,
                            "SELECT scan_id || '/dicom', file, sha256 FROM instances WHERE case_id = :c"
                            " ORDER BY scan_id, file",
                            store.caseFolder(case_id), case_id);
    const auto reports =
        recordedIn(store, "SELECT 'report', file, file_sha256 FROM report_versions WHERE case_id = :c ORDER BY version",
                   store.caseFolder(case_id), case_id);
    files.insert(files.end(), reports.begin(), reports.end());
    return files;
}

std::vector<FileFault> faultsOf(CaseStore& store, Progress& progress, const std::set<std::string>& of_cases,
                                const std::function<std::optional<FileFault::Kind>(const RecordedFile&)>& look)
{
    std::vector<std::string> all = {""};
    for (const CaseRecord& a_case : store.cases())
        all.push_back(a_case.id);
    if (!of_cases.empty())
        std::erase_if(all, [&](const std::string& case_id) { return !of_cases.contains(case_id); });
    std::vector<FileFault> faults;
    for (std::size_t n = 0; n < all.size(); ++n) {
        progress.report(double(n) / double(all.size()),
                        all[n].empty() ? "checking reports" : "checking case " + all[n]);
        for (const RecordedFile& recorded : recordedFiles(store, all[n])) {
            progress.check();
            if (const auto kind = look(recorded))
                faults.push_back({all[n], recorded.file.lexically_relative(store.folder()), *kind});
        }
    }
    return faults;
}

std::optional<FileFault::Kind> missing(const RecordedFile& recorded)
{
    std::error_code none;
    return fs::exists(recorded.file, none) ? std::nullopt : std::optional(FileFault::Kind::missing);
}

}  // namespace

std::string nameOf(FileFault::Kind kind)
{
    switch (kind) {
        case FileFault::Kind::missing:
            return "missing";
        case FileFault::Kind::kept:
            return "kept";
        case FileFault::Kind::changed:
            return "changed";
    }
    return "missing";
}

std::string textOf(const FileFault& fault)
{
    std::string file = (fault.case_id.empty() ? "" : "case " + fault.case_id + ": ") + fault.file.string();
    switch (fault.kind) {
        case FileFault::Kind::missing:
            return file + " is missing";
        case FileFault::Kind::kept:
            return file + " is missing in the store; its earlier copy stays in the backup";
        case FileFault::Kind::changed:
            return file + " is not what it was";
    }
    return file;
}

std::vector<FileFault> missingFiles(CaseStore& store, Progress& progress, const std::set<std::string>& of_cases)
{
    return faultsOf(store, progress, of_cases, missing);
}

std::vector<FileFault> faultyFiles(CaseStore& store, Progress& progress)
{
    return faultsOf(store, progress, {}, [](const RecordedFile& recorded) {
        const auto is_missing = missing(recorded);
        return is_missing || sha256OfFile(recorded.file) == recorded.sha256 ? is_missing
                                                                            : std::optional(FileFault::Kind::changed);
    });
}

}  // namespace vicon
