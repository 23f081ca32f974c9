#include "vicon/cases/backup.h"

#include <soci/soci.h>

#include <cstring>
#include <map>
#include <utility>

#include "database_backup.h"
#include "database_engine.h"
#include "mirror.h"
#include "vicon/cases/case_deletion.h"
#include "vicon/cases/job_queue.h"
#include "vicon/cases/kept_reports.h"
#include "vicon/cases/report_versions.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/file_copy.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

/// In a backup: when it was made, and whether it is whole.
constexpr const char* kAboutName = "backup.json";
/// What of a store cannot be made again, and the results.
constexpr const char* kFolders[] = {"cases", "reports", "quarantine", "incoming"};

/// Tells which case is being copied, of how many.
class Round {
public:
    Round(const fs::path& from, const fs::path& to, Progress& progress) : from_(from), to_(to), progress_(progress) {}

    CopyCounts run(const std::string& name)
    {
        CopyCounts copied;
        progress_.report(0, name);
        for (const char* folder : kFolders)
            mirror(from_ / folder, to_ / folder, copied, progress_, [&](const fs::path&) { ++copied.files; });
        return copied;
    }

private:
    fs::path from_, to_;
    Progress& progress_;
};

void add(CopyCounts& sum, const CopyCounts& round)
{
    sum.files = round.files;
    sum.copied += round.copied;
    sum.removed += round.removed;
    sum.bytes_copied += round.bytes_copied;
}

/// Without a slash at its end.
fs::path wholeNameOf(const fs::path& folder)
{
    return (fs::absolute(folder) / "").lexically_normal().parent_path();
}

void requirePlace(const fs::path& to, const fs::path& store)
{
    const fs::path inside = fs::weakly_canonical(to).lexically_relative(fs::weakly_canonical(store));
    if (!inside.empty() && *inside.begin() != "..")
        throw Error(ErrorCode::wrong_use, "a backup cannot lie in its store", to.string(), "name another folder");
    std::error_code none;
    if (fs::exists(to) && !fs::is_empty(to, none) && !fs::exists(to / kAboutName))
        throw Error(ErrorCode::wrong_use, "the folder holds something else than a backup", to.string(),
                    "name an empty one, or that of an earlier backup");
}

void writeAbout(const fs::path& to, bool whole, int cases)
{
    const nlohmann::json about = {
        {"at", nowUtc()}, {"whole", whole}, {"cases", cases}, {"schema_version", Database::kSchemaVersion}};
    replaceFile(to / kAboutName, about.dump(2) + "\n");
}

bool isWhole(const fs::path& backup)
{
    std::error_code none;
    if (!fs::exists(backup / kAboutName, none))
        return false;
    const auto about = nlohmann::json::parse(readFile(backup / kAboutName), nullptr, false);
    return about.is_object() && about.value("whole", nlohmann::json()) == true;
}

int countCases(soci::session& sql)
{
    int cases = 0;
    sql << "SELECT COUNT(*) FROM cases", soci::into(cases);
    return cases;
}

/// Throws Error{bad_input} for the first object or report that is not what the database says.
void requireWhole(CaseStore& store, Progress& progress)
{
    const auto require = [&](const fs::path& file, const std::string& digest) {
        progress.check();
        if (!fs::exists(file) || sha256OfFile(file) != digest)
            throw Error(ErrorCode::bad_input, "the backup is damaged: an object is missing or not what it was",
                        file.lexically_relative(store.folder()).string(), "restore an older backup");
    };
    const auto cases = store.cases();
    int done = 0;
    for (const CaseRecord& a_case : cases) {
        progress.report(double(done++) / double(cases.size()), "checking case " + a_case.id);
        for (const ScanRecord& scan : store.scans(a_case.id))
            for (const InstanceRecord& instance : store.instances(a_case.id, scan.id))
                require(store.scanFolder(a_case.id, scan.id) / "dicom" / instance.file, instance.sha256);
        for (const ReportVersion& version : reportVersions(store, a_case.id))
            require(version.file, version.file_sha256);
        for (const KeptReport& report : keptReportsOf(store, a_case.patient.id))
            require(keptReportsFolder(store) / report.file, report.sha256);
    }
}

void requireDatabaseOf(const fs::path& backup, const std::string& address)
{
    if (!fs::exists(backup / backupNameOf(address)))
        throw Error(ErrorCode::wrong_use,
                    address.empty() ? "this is the backup of a store whose database lies on a server"
                                    : "this is the backup of a store with a database of its own",
                    backup.string(),
                    address.empty() ? "set store.database to the address of an empty one" : "take store.database away");
}

void copyDatabase(const fs::path& from, const fs::path& folder)
{
    if (const int number = copyBytes(from, folder / from.filename()); number != 0)
        throw Error(ErrorCode::store, std::string("the database cannot be copied (") + std::strerror(number) + ")",
                    folder.string(), "see that the folder is yours and its disk not full, then restore again");
}

void restoreDatabase(const fs::path& backup, const StorePlace& place)
{
    const fs::path file = backup / backupNameOf(place.database);
    if (place.database.empty()) {
        copyDatabase(file, place.folder);
        return;
    }
    copyDatabase(backup / kServersDatabase, place.folder);
    restoreServersDatabase(place.database, file);
}

}  // namespace

CopyCounts backUp(CaseStore& store, const fs::path& given, Progress& progress)
{
    const fs::path to = wholeNameOf(given);
    requirePlace(to, store.folder());
    requireUndamaged(store.database());  // before anything of an earlier backup changes
    makePrivateFolder(to);
    writeAbout(to, false, 0);
    CopyCounts sum;
    Round round(store.folder(), to, progress);
    add(sum, round.run("copying what is new"));
    const StoreLock lock(store.folder(), progress);
    finishDeletions(store, lock);
    const std::string since = nowUtc();
    add(sum, round.run("copying what came meanwhile"));
    if (!store.place().database.empty())
        replaceFile(to / kServersDatabase, readFile(store.folder() / kServersDatabase));
    store.database().write([&](soci::session& sql) {
        backUpDatabase(store.database(), to / backupNameOf(store.place().database));
        sum.cases = countCases(sql);
        // Only their results can be others than a moment ago.
        for (const Job& job : JobQueue(store.database(), {}).workedOnSince(since)) {
            const fs::path scan = fs::path("cases") / job.case_id / job.scan_id;
            mirror(store.folder() / scan, to / scan, sum, progress);
        }
    });
    requireUndamagedCopy(to / backupNameOf(store.place().database));  // its folders took long to copy
    flushDiskOf(to);
    writeAbout(to, true, sum.cases);
    return sum;
}

CopyCounts restore(const fs::path& backup, const StorePlace& given, Progress& progress)
{
    const fs::path to = wholeNameOf(given.folder);
    if (!isWhole(backup))
        throw Error(ErrorCode::bad_input, "there is no whole backup here", backup.string(),
                    "one that was broken off is gone on with by 'vicon backup'");
    requireDatabaseOf(backup, given.database);
    std::error_code none;
    if (fs::exists(to) && !fs::is_empty(to, none))
        throw Error(ErrorCode::wrong_use, "a store is restored into an empty folder", to.string(),
                    "name another one with --store, or move this one away");
    const fs::path making = to.parent_path() / (std::string(kTemporaryPrefix) + to.filename().string());
    fs::remove_all(making, none);
    try {
        makePrivateFolder(making);
        CopyCounts copied = Round(backup, making, progress).run("copying");
        restoreDatabase(backup, {making, given.database});
        {
            CaseStore store({making, given.database});
            requireWhole(store, progress);
            copied.cases = store.database().read(countCases);
        }
        flushDiskOf(making);
        fs::remove(to, none);
        fs::rename(making, to);
        flushDiskOf(to);
        return copied;
    } catch (const fs::filesystem_error& e) {
        fs::remove_all(making, none);
        throw Error(ErrorCode::store, "the store cannot be restored (" + e.code().message() + ")", to.string(),
                    "check that its disk has room, and that the folder above is yours");
    } catch (...) {
        fs::remove_all(making, none);
        throw;
    }
}

}  // namespace vicon
