#include "mirror.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <set>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/file_copy.h"
#include "vicon/core/file_modes.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

Error failure(const std::string& what, const fs::path& where, int number)
{
    return {ErrorCode::store, what + " (" + std::strerror(number) + ")", where.string(),
            number == ENOSPC || number == EDQUOT ? "free some space on this disk and run again"
                                                 : "check that both folders are yours"};
}

/// A journal is there for a crash: what it holds a copy of is in the store's folders too.
bool isPassedOver(const fs::path& name)
{
    return name.string().starts_with(kTemporaryPrefix) || name.extension() == ".lock" || name.extension() == ".journal";
}

/// As far as size and time tell: every file of a store is written anew when it changes, none is written into.
bool isSame(const fs::path& a, const fs::path& b)
{
    struct stat x {};
    struct stat y {};
    return ::stat(a.c_str(), &x) == 0 && ::stat(b.c_str(), &y) == 0 && x.st_size == y.st_size &&
           x.st_mtim.tv_sec == y.st_mtim.tv_sec && x.st_mtim.tv_nsec == y.st_mtim.tv_nsec;
}

/// Whether what was copied is kept from the place of `to`: it is not what it must be, and there is something already.
bool staysAway(const fs::path& temporary, const fs::path& to, const std::string& sha256, const MirrorCalls& calls)
{
    if (!fs::exists(to)) {
        calls.changed(to, false);
        return false;
    }
    calls.changed(to, sha256OfFile(to) == sha256);
    fs::remove(temporary);
    return true;
}

/// Nothing where the file has gone meanwhile.
void copyFile(const fs::path& from, const fs::path& to, CopyCounts& copied, const MirrorCalls& calls)
{
    const fs::path temporary = to.parent_path() / (std::string(kTemporaryPrefix) + to.filename().string());
    std::error_code trouble;
    const auto time = fs::last_write_time(from, trouble);
    if (trouble == std::errc::no_such_file_or_directory)
        return;
    const int number = copyBytes(from, temporary);
    if (number == ENOENT && !fs::exists(from))
        return;
    if (number != 0)
        throw failure("a file cannot be copied", to, number);
    const std::string sha256 = calls.sha256_of ? calls.sha256_of(to) : "";
    const bool is_good = sha256.empty() || sha256OfFile(temporary) == sha256;
    if (!is_good && staysAway(temporary, to, sha256, calls))
        return;
    if (is_good)  // else it keeps a time of its own, by which the next mirror looks at it again
        fs::last_write_time(temporary, time, trouble);
    if (trouble || ::chmod(temporary.c_str(), fileModeIn(to.parent_path())) != 0 ||
        ::rename(temporary.c_str(), to.c_str()) != 0)
        throw failure("a file cannot be copied", to, trouble ? trouble.value() : errno);
    ++copied.copied;
    copied.bytes_copied += fs::file_size(to);
}

std::set<std::string> namesIn(const fs::path& folder)
{
    std::set<std::string> names;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none))
        if (!isPassedOver(entry.path().filename()))
            names.insert(entry.path().filename().string());
    return names;
}

int filesBelow(const fs::path& place)
{
    if (!fs::is_directory(place))
        return 1;
    int count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(place))
        count += entry.is_directory() ? 0 : 1;
    return count;
}

void removeOthers(const fs::path& folder, const std::set<std::string>& names, const KeptFiles& kept, CopyCounts& copied)
{
    removeTemporaries(folder);
    for (const std::string& name : namesIn(folder)) {
        const fs::path place = folder / name;
        if (names.contains(name))
            continue;
        if (kept.contains(place)) {
            if (fs::is_directory(place))
                removeOthers(place, {}, kept, copied);
            continue;
        }
        copied.removed += filesBelow(place);
        fs::remove_all(place);
    }
}

}  // namespace

void mirror(const fs::path& from, const fs::path& to, const KeptFiles& kept, CopyCounts& copied, Progress& progress,
            const MirrorCalls& calls)
try {
    const std::set<std::string> names = namesIn(from);
    if (names.empty() && !fs::exists(to))
        return;
    makePrivateFolder(to);
    removeOthers(to, names, kept, copied);
    for (const std::string& name : names) {
        progress.check();
        if (fs::is_directory(from / name)) {
            mirror(from / name, to / name, kept, copied, progress, calls);
            continue;
        }
        if (!isSame(from / name, to / name))
            copyFile(from / name, to / name, copied, calls);
        if (calls.seen)
            calls.seen(to / name);
    }
} catch (const fs::filesystem_error& e) {
    throw failure("a folder cannot be copied", e.path1(), e.code().value());
}

void mirrorFile(const fs::path& from, const fs::path& to, CopyCounts& copied)
{
    if (!isSame(from, to))
        copyFile(from, to, copied, {});
}

void flushDiskOf(const fs::path& folder)
{
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool flushed = descriptor >= 0 && ::syncfs(descriptor) == 0;
    const int number = errno;
    if (descriptor >= 0)
        ::close(descriptor);
    if (!flushed)
        throw failure("cannot be flushed to disk", folder, number);
}

}  // namespace vicon
