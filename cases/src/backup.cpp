#include "vicon/cases/backup.h"

#include <soci/soci.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>

#include "changed_cases.h"
#include "database_backup.h"
#include "database_engine.h"
#include "mirror.h"
#include "recorded_files.h"
#include "store_copying.h"
#include "vicon/cases/audit_trail.h"
#include "vicon/cases/case_deletion.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/file_copy.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

/// In a backup: when it was made, and whether it is whole.
constexpr const char* kAboutName = "backup.json";
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

/// A database that was lost and made anew knows no case of before: its backup would take the place of all of them.
/// Cases that were deleted are known by the audit trail.
void requireKnownCases(CaseStore& store, const fs::path& to)
{
    int others = 0;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(to / "cases", none)) {
        const std::string id = entry.path().filename().string();
        if (store.findCase(id) || !auditTrail(store, id).empty())
            return;
        others += entry.is_directory() ? 1 : 0;
    }
    if (others > 0)
        throw Error(ErrorCode::wrong_use,
                    "the backup there holds " + std::to_string(others) + " cases, and this store never had one of them",
                    to.string(),
                    "was the store's database lost? then 'vicon restore' makes a store of the backup; else name an "
                    "empty folder");
}

/// @param missing files of which the backup has no good copy
void writeAbout(const fs::path& to, bool whole, int cases, int missing)
{
    const nlohmann::json about = {{"at", nowUtc()},
                                  {"whole", whole},
                                  {"cases", cases},
                                  {"missing", missing},
                                  {"schema_version", Database::kSchemaVersion}};
    replaceFile(to / kAboutName, about.dump(2) + "\n");
}

/// Whether it was brought to its end, also where the store had lost something.
bool isFinished(const fs::path& backup)
{
    std::error_code none;
    if (!fs::exists(backup / kAboutName, none))
        return false;
    const auto about = nlohmann::json::parse(readFile(backup / kAboutName), nullptr, false);
    if (!about.is_object())
        return false;
    const auto missing = about.value("missing", nlohmann::json());
    return about.value("whole", nlohmann::json()) == true || (missing.is_number_integer() && missing > 0);
}

int countCases(soci::session& sql)
{
    int cases = 0;
    sql << "SELECT COUNT(*) FROM cases", soci::into(cases);
    return cases;
}

std::set<std::string> casesOf(const std::vector<FileFault>& faults)
{
    std::set<std::string> cases;
    for (const FileFault& fault : faults)
        cases.insert(fault.case_id);
    return cases;
}

/// Those which are missing still: a case may have been deleted while its files were looked for.
std::vector<FileFault> stillMissing(CaseStore& store, const fs::path& to, const std::vector<FileFault>& missing,
                                    Progress& progress)
{
    return missing.empty() ? missing : missingFiles(store, to, progress, casesOf(missing));
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

/// Nothing where the database lies in the store's folder.
std::optional<FilledDatabase> restoreDatabase(const fs::path& backup, const StorePlace& place)
{
    const fs::path file = backup / backupNameOf(place.database);
    if (place.database.empty()) {
        copyDatabase(file, place.folder);
        return std::nullopt;
    }
    copyDatabase(backup / kServersDatabase, place.folder);
    return std::optional<FilledDatabase>(std::in_place, place.database, file);
}

/// What is done while imports and deletions wait; while nobody can write, only what was just changed is copied.
std::unique_ptr<DatabaseSnapshot> copyTheRest(CaseStore& store, const fs::path& to, StoreCopying& copying,
                                              Progress& progress)
{
    CopyCounts& counts = copying.counts();
    const StoreLock lock(store.folder(), progress);
    finishDeletions(store, lock);
    counts.faults = stillMissing(store, to, counts.faults, progress);
    copying.keep(counts.faults);
    ChangedCases since_all(store);
    copying.copyAll("copying what came meanwhile");
    if (!store.place().database.empty())
        replaceFile(to / kServersDatabase, readFile(store.folder() / kServersDatabase));
    ChangedCases since_those(store);
    copying.copyCases(since_all.untilNow());
    std::unique_ptr<DatabaseSnapshot> snapshot;
    store.database().write([&](soci::session& sql) {
        snapshot = std::make_unique<DatabaseSnapshot>(store.database());
        counts.cases = countCases(sql);
        copying.copyCases(since_those.untilNow());
    });
    return snapshot;
}

/// Says of each fault whether the backup has an earlier copy. Returns of how many it has no good one.
int judge(CopyCounts& counts, const StoreCopying& copying, const fs::path& to)
{
    for (FileFault& missing : counts.faults)
        missing.kind = fs::exists(to / missing.file) ? FileFault::Kind::kept : FileFault::Kind::missing;
    const auto changed = copying.changed();
    counts.faults.insert(counts.faults.end(), changed.begin(), changed.end());
    std::stable_sort(counts.faults.begin(), counts.faults.end(),
                     [](const FileFault& a, const FileFault& b) { return a.case_id < b.case_id; });
    return int(std::count_if(counts.faults.begin(), counts.faults.end(), [](const FileFault& fault) {
        return fault.kind == FileFault::Kind::missing || fault.kind == FileFault::Kind::changed;
    }));
}

}  // namespace

CopyCounts backUp(CaseStore& store, const fs::path& given, Progress& progress)
{
    const fs::path to = wholeNameOf(given);
    requirePlace(to, store.folder());
    requireUndamaged(store.database());  // before anything of an earlier backup changes
    requireKnownCases(store, to);
    makePrivateFolder(to);
    writeAbout(to, false, 0, 0);
    RecordedHashes recorded(store, to);
    StoreCopying copying(store.folder(), to, &recorded, progress);
    CopyCounts& counts = copying.counts();
    counts.faults = missingFiles(store, to, progress);
    copying.keep(counts.faults);
    copying.copyAll("copying what is new");
    const fs::path database = to / backupNameOf(store.place().database);
    auto snapshot = copyTheRest(store, to, copying, progress);
    progress.report(1, "copying the database");
    snapshot->writeTo(database);
    snapshot.reset();
    requireUndamagedCopy(database);  // the folders took long to copy
    const int lost = judge(counts, copying, to);
    flushDiskOf(to);
    writeAbout(to, lost == 0, counts.cases, lost);
    return counts;
}

CopyCounts restore(const fs::path& backup, const StorePlace& given, Progress& progress)
{
    const fs::path to = wholeNameOf(given.folder);
    if (!isFinished(backup))
        throw Error(ErrorCode::bad_input, "there is no finished backup here", backup.string(),
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
        StoreCopying copying(backup, making, nullptr, progress);
        copying.copyAll("copying");
        auto filled = restoreDatabase(backup, {making, given.database});
        CopyCounts& copied = copying.counts();
        {
            CaseStore store({making, given.database});
            copied.faults = faultyFiles(store, progress);
            copied.cases = store.database().read(countCases);
        }
        flushDiskOf(making);
        fs::remove(to, none);
        fs::rename(making, to);
        if (filled)
            filled->keep();
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
