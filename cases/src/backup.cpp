#include "vicon/cases/backup.h"

#include <soci/soci.h>

#include <cstring>
#include <memory>
#include <optional>

#include "changed_cases.h"
#include "database_backup.h"
#include "database_engine.h"
#include "mirror.h"
#include "recorded_files.h"
#include "vicon/cases/case_deletion.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/file_copy.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

/// In a backup: when it was made, and whether it is whole.
constexpr const char* kAboutName = "backup.json";
/// What of a store cannot be made again, and the results.
constexpr const char* kFolders[] = {"cases", "reports", "quarantine", "incoming", "watch", "commitments"};
/// By which a patient gets the same pseudonym again.
constexpr const char* kFiles[] = {"anonymous.key"};

/// Copies a store's files, in several rounds over what is there already.
class Copying {
public:
    Copying(const fs::path& from, const fs::path& to, Progress& progress) : from_(from), to_(to), progress_(progress) {}

    /// What the store has lost, and the copy has: it stays there.
    void keep(const std::vector<FileFault>& missing)
    {
        kept_.clear();
        for (const FileFault& fault : missing)
            for (fs::path place = to_ / fault.file; place != to_; place = place.parent_path())
                kept_.insert(place);
    }
    void copyAll(const std::string& name)
    {
        progress_.report(0, name);
        counts_.files = 0;
        for (const char* folder : kFolders)
            mirror(from_ / folder, to_ / folder, kept_, counts_, progress_, [&](const fs::path&) { ++counts_.files; });
        for (const char* file : kFiles)
            if (fs::exists(from_ / file)) {
                mirrorFile(from_ / file, to_ / file, counts_);
                ++counts_.files;
            }
    }
    void copyCases(const std::set<std::string>& cases)
    {
        for (const std::string& case_id : cases) {
            progress_.report(0, "copying case " + case_id);
            const fs::path folder = fs::path("cases") / case_id;
            mirror(from_ / folder, to_ / folder, kept_, counts_, progress_);
        }
    }
    CopyCounts& counts() { return counts_; }

private:
    fs::path from_, to_;
    Progress& progress_;
    KeptFiles kept_;
    CopyCounts counts_;
};

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

/// @param missing files that the store has lost and no earlier backup had
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
std::vector<FileFault> stillMissing(CaseStore& store, const std::vector<FileFault>& missing, Progress& progress)
{
    return missing.empty() ? missing : missingFiles(store, progress, casesOf(missing));
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
std::unique_ptr<DatabaseSnapshot> copyTheRest(CaseStore& store, const fs::path& to, Copying& copying,
                                              Progress& progress)
{
    CopyCounts& counts = copying.counts();
    const StoreLock lock(store.folder(), progress);
    finishDeletions(store, lock);
    counts.faults = stillMissing(store, counts.faults, progress);
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

}  // namespace

CopyCounts backUp(CaseStore& store, const fs::path& given, Progress& progress)
{
    const fs::path to = wholeNameOf(given);
    requirePlace(to, store.folder());
    requireUndamaged(store.database());  // before anything of an earlier backup changes
    makePrivateFolder(to);
    writeAbout(to, false, 0, 0);
    Copying copying(store.folder(), to, progress);
    CopyCounts& counts = copying.counts();
    counts.faults = missingFiles(store, progress);
    copying.keep(counts.faults);
    copying.copyAll("copying what is new");
    const fs::path database = to / backupNameOf(store.place().database);
    auto snapshot = copyTheRest(store, to, copying, progress);
    progress.report(1, "copying the database");
    snapshot->writeTo(database);
    snapshot.reset();
    requireUndamagedCopy(database);  // the folders took long to copy
    int missing = 0;
    for (FileFault& fault : counts.faults) {
        const bool is_kept = fs::exists(to / fault.file);
        fault.kind = is_kept ? FileFault::Kind::kept : FileFault::Kind::missing;
        missing += is_kept ? 0 : 1;
    }
    flushDiskOf(to);
    writeAbout(to, missing == 0, counts.cases, missing);
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
        Copying copying(backup, making, progress);
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
