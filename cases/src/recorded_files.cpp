#include "recorded_files.h"

#include <soci/soci.h>

#include <functional>

#include "version_objects.h"
#include "vicon/cases/kept_reports.h"
#include "vicon/cases/report_files.h"
#include "vicon/cases/report_versions.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

struct RecordedFile {
    fs::path file;
    std::string sha256;  ///< empty: none was kept
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

/// The DICOM objects of a case's signed versions; of those of an earlier VICON what an earlier backup has.
std::vector<RecordedFile> recordedObjects(CaseStore& store, const std::string& case_id, const fs::path& backup)
{
    const fs::path folder = reportFolder(store, case_id);
    return store.database().read([&](soci::session& sql) {
        std::vector<RecordedFile> files;
        const soci::rowset<soci::row> rows =
            (sql.prepare << "SELECT version, objects FROM report_versions WHERE case_id = :c AND state <> 'preliminary'"
                            " ORDER BY version",
             soci::use(case_id));
        for (const soci::row& row : rows) {
            const auto hashes = objectHashesFrom(row.get<std::string>("objects"));
            for (const auto& [name, sha256] : hashes.value_or(ObjectHashes()))
                files.push_back({folder / name, sha256});
            if (hashes || backup.empty())
                continue;
            const fs::path copies = backup / folder.lexically_relative(store.folder());
            for (const fs::path& copy : versionObjectsIn(copies, row.get<int>("version")))
                files.push_back({folder / copy.filename(), ""});
        }
        return files;
    });
}

/// Of a case, or the reports kept of patients ("").
std::vector<RecordedFile> recordedFiles(CaseStore& store, const std::string& case_id, const fs::path& backup)
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
    const auto objects = recordedObjects(store, case_id, backup);
    files.insert(files.end(), objects.begin(), objects.end());
    return files;
}

std::vector<FileFault> faultsOf(CaseStore& store, const fs::path& backup, Progress& progress,
                                const std::set<std::string>& of_cases,
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
        for (const RecordedFile& recorded : recordedFiles(store, all[n], backup)) {
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
        case FileFault::Kind::changed_kept:
            return "changed_kept";
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
        case FileFault::Kind::changed_kept:
            return file + " is not what it was in the store; its earlier copy stays in the backup";
    }
    return file;
}

std::vector<FileFault> missingFiles(CaseStore& store, const fs::path& backup, Progress& progress,
                                    const std::set<std::string>& of_cases)
{
    return faultsOf(store, backup, progress, of_cases, missing);
}

std::vector<FileFault> faultyFiles(CaseStore& store, Progress& progress)
{
    return faultsOf(store, {}, progress, {}, [](const RecordedFile& recorded) {
        const auto is_missing = missing(recorded);
        return is_missing || sha256OfFile(recorded.file) == recorded.sha256 ? is_missing
                                                                            : std::optional(FileFault::Kind::changed);
    });
}

std::string RecordedHashes::of(const fs::path& file)
{
    const auto case_id = caseOf(file);
    if (!case_id)
        return {};
    if (case_id != case_id_) {
        hashes_.clear();
        for (const RecordedFile& recorded : recordedFiles(store_, *case_id, backup_))
            hashes_[recorded.file.lexically_relative(store_.folder())] = recorded.sha256;
        case_id_ = case_id;
    }
    const auto found = hashes_.find(file);
    if (found == hashes_.end())
        return {};
    return found->second.empty() ? sha256OfFile(backup_ / file) : found->second;
}

std::optional<std::string> caseOf(const fs::path& file)
{
    auto part = file.begin();
    if (part == file.end() || (*part != "cases" && *part != "reports"))
        return std::nullopt;
    if (*part == "reports")
        return "";
    return ++part == file.end() ? std::nullopt : std::optional(part->string());
}

}  // namespace vicon
