#include "vicon/cases/store_locks.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/file_modes.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

/// Outside the case's folder, which a deletion takes away.
fs::path lockOf(const fs::path& store, const std::string& case_id)
{
    return store / "in_use" / case_id;
}

struct Waiting {
    const fs::path& store;
    Progress& progress;
    double done;

    /// The file of this name, locked.
    int locked(const char* name) const
    {
        constexpr auto kPause = std::chrono::milliseconds(10);
        const int descriptor = openOrMake(store / name);
        if (descriptor < 0)
            throw Error(ErrorCode::store, std::string("the store cannot be locked (") + std::strerror(errno) + ")",
                        store.string(), "check that the folder is yours, and its disk not full");
        while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
            try {
                progress.report(done, "waiting for another import, deletion or backup of this store");
                progress.check();
            } catch (...) {
                ::close(descriptor);
                throw;
            }
            std::this_thread::sleep_for(kPause);
        }
        return descriptor;
    }
};

/// Whether this is still the file of that name: who waited for a lock may have got that of a file that is gone.
bool isStillThere(int descriptor, const fs::path& file)
{
    struct stat held {};
    struct stat named {};
    return ::fstat(descriptor, &held) == 0 && ::stat(file.c_str(), &named) == 0 && held.st_ino == named.st_ino;
}

}  // namespace

StoreLock::StoreLock(const fs::path& store, Progress& progress, double done)
{
    const Waiting waiting{store, progress, done};
    const int turn = waiting.locked("import.turn");  // one waits for the store, the others for the turn
    try {
        descriptor_ = waiting.locked("import.lock");
    } catch (...) {
        ::close(turn);
        throw;
    }
    ::close(turn);
}

StoreLock::~StoreLock()
{
    ::close(descriptor_);
}

CaseInUse::CaseInUse(const fs::path& store, const std::string& case_id) noexcept : descriptor_(-1)
{
    try {
        makePrivateFolder(store / "in_use");
        descriptor_ = openOrMake(lockOf(store, case_id));
        if (descriptor_ >= 0)
            ::flock(descriptor_, LOCK_SH | LOCK_NB);
    } catch (const std::exception&) {  // a store that cannot be written to: nobody can delete there either
    }
}

CaseInUse::~CaseInUse()
{
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

CaseUnused::CaseUnused(const fs::path& store, const std::string& case_id) : file_(lockOf(store, case_id))
{
    makePrivateFolder(file_.parent_path());
    descriptor_ = openOrMake(file_);
    if (descriptor_ < 0)
        throw Error(ErrorCode::store, std::string("the case cannot be locked (") + std::strerror(errno) + ")", case_id,
                    "check that the store is yours, and its disk not full");
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 && isStillThere(descriptor_, file_))
        return;
    ::close(descriptor_);
    throw Error(ErrorCode::store, "somebody has the case open", case_id, "have it closed, then try again");
}

CaseUnused::~CaseUnused()
{
    ::close(descriptor_);
}

void CaseUnused::forget()
{
    std::error_code ignored;
    fs::remove(file_, ignored);
}

}  // namespace vicon
