#include "journal_part.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>
#include <vector>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/file_modes.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

/// Of a part: about thirty slices of 512 x 512. Two of them bound what a start after a crash puts back.
constexpr std::uint64_t kPartBytes = 16U << 20U;
constexpr std::uint64_t kHeadBytes = 4096;  // of a part and of each copy; places are multiples of it
constexpr std::size_t kCopiedAtOnce = 64U << 10U, kZerosAtOnce = 1U << 20U;
constexpr const char* kPartMagic = "vicon-arrivals-1";

[[noreturn]] void partFailed(const std::string& what, const fs::path& where)
{
    const int number = errno;
    throw Error(ErrorCode::store, what + " (" + std::strerror(number) + ")", where.string(),
                "free some space on this disk, and check that the store is yours");
}

std::uint64_t placesFor(std::uint64_t bytes)
{
    return kHeadBytes + (bytes + kHeadBytes - 1) / kHeadBytes * kHeadBytes;
}

/// Whoever does not know it cannot write what looks like the head of a copy.
std::string newKey()
{
    std::random_device random;
    std::ostringstream key;
    for (int n = 0; n < 4; ++n)
        key << std::hex << std::uint32_t(random()) << '-';
    return key.str();
}

void writeAt(int descriptor, std::string_view bytes, std::uint64_t place, const fs::path& file)
{
    while (!bytes.empty()) {
        const ssize_t some = ::pwrite(descriptor, bytes.data(), bytes.size(), off_t(place));
        if (some < 0 && errno == EINTR)
            continue;
        if (some <= 0)
            partFailed("cannot be written", file);
        bytes.remove_prefix(std::size_t(some));
        place += std::uint64_t(some);
    }
}

/// A line, filled up to the length of a head.
std::string headOf(const std::string& line)
{
    std::string head = line + "\n";
    head.resize(kHeadBytes);
    return head;
}

std::string lineIn(const std::string& head)
{
    return head.substr(0, head.find('\n'));
}

using Crc = std::uint32_t;

Crc crcOf(Crc before, std::string_view bytes)
{
    return Crc(::crc32(before, reinterpret_cast<const Bytef*>(bytes.data()), uInt(bytes.size())));
}

struct CopyHead {
    std::string key, name;
    std::uint64_t bytes = 0;
    Crc crc = 0;  ///< of the copy

    std::string line() const
    {
        std::ostringstream text;
        text << key << ' ' << bytes << ' ' << crc << ' ' << name;
        return text.str();
    }
    static CopyHead from(const std::string& line)
    {
        CopyHead head;
        std::istringstream text(line);
        text >> head.key >> head.bytes >> head.crc;
        text.ignore(1);
        std::getline(text, head.name);
        return head;
    }
};

/// The name of a file in a folder, and nothing that leads out of it.
bool leadsInside(const std::string& name)
{
    const fs::path path(name);
    return path.is_relative() && !path.empty() && path == path.lexically_normal() && *path.begin() != "..";
}

/// Calls back with the bytes of a stretch of a file, block by block; false when they are not all there.
template <class Take>
bool readStretch(std::istream& in, std::uint64_t place, std::uint64_t bytes, Take take)
{
    std::vector<char> block(std::min<std::uint64_t>(bytes, kCopiedAtOnce));
    in.clear();
    in.seekg(std::streamoff(place));
    while (bytes > 0) {
        const auto some = std::min<std::uint64_t>(bytes, block.size());
        if (!in.read(block.data(), std::streamsize(some)))
            return false;
        take(std::string_view(block.data(), some));
        bytes -= some;
    }
    return true;
}

bool isWhole(std::istream& in, std::uint64_t place, const CopyHead& head)
{
    Crc crc = 0;
    return readStretch(in, place, head.bytes, [&](std::string_view block) { crc = crcOf(crc, block); }) &&
           crc == head.crc;
}

void restoreCopy(std::istream& in, std::uint64_t place, const CopyHead& head, const fs::path& file)
{
    makePrivateFolder(file.parent_path());
    replaceFile(file, [&](const fs::path& temporary) {
        std::error_code none;
        std::ifstream there(file, std::ios::binary);
        const bool same = there && fs::file_size(file, none) == head.bytes && isWhole(there, 0, head);
        if (same)  // it needs no more than to be flushed
            return fs::rename(file, temporary);
        std::ofstream out(temporary, std::ios::binary);
        readStretch(in, place, head.bytes,
                    [&](std::string_view block) { out.write(block.data(), std::streamsize(block.size())); });
        if (!out.flush())
            partFailed("cannot be put back", file);
    });
}

}  // namespace

JournalPart::~JournalPart()
{
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

bool JournalPart::mayHold(std::uint64_t bytes)
{
    return bytes <= kPartBytes / 4;
}

bool JournalPart::hasRoomFor(std::uint64_t bytes) const
{
    return std::max(end_, kHeadBytes) + placesFor(bytes) <= kPartBytes;
}

std::uint64_t JournalPart::reserve(std::uint64_t bytes)
{
    if (descriptor_ < 0)
        open();
    struct stat about {};
    if (::fstat(descriptor_, &about) != 0 || about.st_nlink == 0)
        throw Error(ErrorCode::store, "the store was deleted", file_.string());
    if (end_ == 0)
        writeHead();
    const std::uint64_t place = end_;
    end_ += placesFor(bytes);
    return place;
}

void JournalPart::open()
{
    descriptor_ = openOrMake(file_, O_TRUNC);
    if (descriptor_ < 0)
        partFailed("cannot be made", file_);
    errno = flushToDisk(file_.parent_path());
    if (errno != 0)
        partFailed("cannot be made", file_);
    if (hasPlentyOfRoom())
        writeZeros(kPartBytes);
}

/// On a disk that is nearly full the copies take what they need, and give it back.
bool JournalPart::hasPlentyOfRoom() const
{
    constexpr std::uintmax_t kPlenty = 64 * kPartBytes;
    std::error_code unknown;
    const fs::space_info space = fs::space(file_, unknown);
    return !unknown && space.available >= kPlenty;
}

/// Over the beginning, so that its blocks are there: a flush that has to allocate some takes three times as long.
void JournalPart::writeZeros(std::uint64_t bytes)
{
    const std::string zeros(kZerosAtOnce, '\0');
    for (std::uint64_t at = 0; at < bytes; at += zeros.size())
        writeAt(descriptor_, std::string_view(zeros).substr(0, bytes - at), at, file_);
}

void JournalPart::writeHead()
{
    key_ = newKey();
    writeAt(descriptor_, headOf(std::string(kPartMagic) + " " + key_), 0, file_);
    end_ = kHeadBytes;
}

void JournalPart::copy(const fs::path& from, std::uint64_t bytes, std::uint64_t place, const std::string& name)
{
    std::ifstream in(from, std::ios::binary);
    std::string copy(kHeadBytes + bytes, '\0');  // written at once: a sender waits
    if (!in.read(copy.data() + kHeadBytes, std::streamsize(bytes)))
        partFailed("cannot be read", from);
    const Crc crc = crcOf(0, std::string_view(copy).substr(kHeadBytes));
    copy.replace(0, kHeadBytes, headOf(CopyHead{key_, name, bytes, crc}.line()));
    writeAt(descriptor_, copy, place, file_);
    flush();
}

/// What the disk could not write it says to one of those that wait: the others have to learn it here.
void JournalPart::flush()
{
    std::unique_lock lock(mutex_);
    const std::uint64_t mine = ++asked_;
    while (flushed_ < mine && !broken_) {
        if (flushing_) {
            changed_.wait(lock);
            continue;
        }
        flushing_ = true;
        const std::uint64_t these = asked_;
        lock.unlock();
        const bool done = ::fdatasync(descriptor_) == 0;
        lock.lock();
        flushing_ = false;
        broken_ = broken_ || !done;
        flushed_ = done ? these : flushed_;
        changed_.notify_all();
    }
    if (broken_)
        throw Error(ErrorCode::store, "cannot be flushed to disk", file_.string());
}

void JournalPart::renew()
{
    if (broken_)
        return clear();
    writeHead();
    flush();
}

void JournalPart::clear()
{
    const std::uint64_t used = end_;
    end_ = 0;
    if (!broken_ && hasPlentyOfRoom())
        writeZeros(used);
    else if (::ftruncate(descriptor_, 0) != 0)
        partFailed("cannot be emptied", file_);
    if (::fsync(descriptor_) != 0)
        partFailed("cannot be emptied", file_);
}

void restoreCopies(const fs::path& part, const fs::path& folder)
{
    std::ifstream in(part, std::ios::binary);
    std::string head;
    const auto readHead = [&](std::uint64_t place) {
        head.clear();
        return readStretch(in, place, kHeadBytes, [&](std::string_view block) { head += block; });
    };
    if (!in || !readHead(0) || !lineIn(head).starts_with(std::string(kPartMagic) + " "))
        return;
    const std::string key = lineIn(head).substr(std::strlen(kPartMagic) + 1);
    for (std::uint64_t place = kHeadBytes; readHead(place);) {
        const CopyHead found = CopyHead::from(lineIn(head));
        const bool whole = !key.empty() && found.key == key && leadsInside(found.name) &&
                           JournalPart::mayHold(found.bytes) && isWhole(in, place + kHeadBytes, found);
        if (whole)
            restoreCopy(in, place + kHeadBytes, found, folder / found.name);
        place += whole ? placesFor(found.bytes) : kHeadBytes;
    }
}

}  // namespace vicon::ingest
