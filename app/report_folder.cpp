#include "report_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "vicon/core/error.h"
#include "vicon/core/temporary_folder.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

constexpr const char* kName = "vicon-report-";
constexpr const char* kLock = "in-use";

/// Whether no process uses it: its lock is free. One without a lock may be about to get it, unless it is old.
bool isLeftBehind(const fs::path& folder)
{
    struct stat of {};
    if (::lstat(folder.c_str(), &of) != 0 || !S_ISDIR(of.st_mode) || of.st_uid != ::getuid())
        return false;
    const int lock = ::open((folder / kLock).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    if (lock < 0) {
        constexpr auto kOld = std::chrono::hours(24);
        std::error_code ignored;
        const auto made = fs::last_write_time(folder, ignored);
        return !ignored && fs::file_time_type::clock::now() - made > kOld;
    }
    const bool is_free = ::flock(lock, LOCK_EX | LOCK_NB) == 0;
    ::close(lock);
    return is_free;
}

void removeLeftBehind()
{
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(fs::temp_directory_path(ignored), ignored))
        if (entry.path().filename().string().starts_with(kName) && isLeftBehind(entry.path()))
            fs::remove_all(entry.path(), ignored);
}

}  // namespace

ReportFolder::ReportFolder()
{
    removeLeftBehind();
    path_ = makeTemporaryFolder(kName, ErrorCode::store);
    // Under another name until it is locked: whoever finds the lock finds it taken.
    const fs::path unlocked = path_ / "new";
    lock_ = ::open(unlocked.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR);
    if (lock_ < 0 || ::flock(lock_, LOCK_EX | LOCK_NB) != 0 || ::rename(unlocked.c_str(), (path_ / kLock).c_str()) != 0)
        throw Error(ErrorCode::store, "a temporary folder cannot be used", path_.string());
}

ReportFolder::~ReportFolder()
{
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    ::close(lock_);
}

}  // namespace vicon::app
