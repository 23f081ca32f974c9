#include "stored_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <mutex>

#include "vicon/core/file.h"
#include "vicon/core/file_copy.h"
#include "vicon/core/file_modes.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

/// Files that are copied at once, whatever the number of cores: each waits for the disk until it is flushed.
constexpr int kAtOnce = 8;

bool isFull(int number)
{
    return number == ENOSPC || number == EDQUOT;
}

Error failure(const std::string& what, const fs::path& where, int number)
{
    return {ErrorCode::store, what + " (" + std::strerror(number) + ")", where.string(),
            isFull(number) ? "free some space on this disk and import again" : "check that the store is yours"};
}

[[noreturn]] void failed(const std::string& what, const fs::path& where, int number)
{
    throw failure(what, where, number);
}

void flush(const fs::path& path)
{
    if (const int number = flushToDisk(path); number != 0)
        failed("cannot be flushed to disk", path, number);
}

void copyPrivately(const fs::path& from, const fs::path& to)
{
    if (const int number = copyBytes(from, to); number != 0)
        throw notCopied(from, to, number);
    if (::chmod(to.c_str(), fileModeIn(to.parent_path())) != 0)
        failed("cannot be made private", to, errno);
    flush(to);
}

fs::path temporaryFor(const fs::path& folder, const std::string& name)
{
    return folder / (std::string(kTemporaryPrefix) + name);
}

}  // namespace

std::string fileNameFor(const std::string& sop_uid)
{
    constexpr std::size_t kDigits = 32;
    return sha256(sop_uid).substr(0, kDigits) + ".dcm";
}

Error notCopied(const fs::path& from, const fs::path& to, int number)
{
    return failure("a file cannot be copied into the store", isFull(number) ? to.parent_path() : from, number);
}

void copyDurably(const fs::path& folder, const std::vector<FileCopy>& copies, Progress& progress)
{
    makePrivateFolder(folder);
    removeTemporaries(folder);
    std::mutex telling;
    const tbb::global_control more(tbb::global_control::max_allowed_parallelism, kAtOnce);
    tbb::task_arena waiting(kAtOnce);
    try {
        waiting.execute([&] {
            tbb::parallel_for(std::size_t(0), copies.size(), [&](std::size_t n) {
                {
                    const std::lock_guard lock(telling);
                    progress.check();
                }
                copyPrivately(copies[n].from, temporaryFor(folder, copies[n].name));
            });
        });
        for (const FileCopy& copy : copies)
            if (::rename(temporaryFor(folder, copy.name).c_str(), (folder / copy.name).c_str()) != 0)
                failed("cannot be renamed", folder / copy.name, errno);
    } catch (...) {
        removeTemporaries(folder);
        throw;
    }
    flush(folder);
}

}  // namespace vicon::ingest
