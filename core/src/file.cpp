#include "vicon/core/file.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <fstream>
#include <memory>
#include <sstream>

#include "vicon/core/error.h"
#include "vicon/core/file_modes.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

[[noreturn]] void failed(const std::string& what, const fs::path& where)
{
    const int number = errno;
    const bool full = number == ENOSPC || number == EDQUOT;
    throw Error(ErrorCode::store, what + " (" + std::strerror(number) + ")", where.string(),
                full ? "free some space on this disk and run again" : "check that the folder exists and is yours");
}

void flush(const fs::path& path)
{
    errno = flushToDisk(path);
    if (errno != 0)
        failed("cannot be flushed to disk", path);
}

fs::path temporaryNameFor(const fs::path& target)
{
    static std::atomic<unsigned> counter{0};
    std::ostringstream name;
    name << kTemporaryPrefix << ::getpid() << '-' << counter++ << '-' << target.filename().string();
    return target.parent_path() / name.str();
}

struct Digest {
    std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context{EVP_MD_CTX_new(), EVP_MD_CTX_free};
    Digest() { EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr); }
    void add(const char* bytes, std::size_t count) { EVP_DigestUpdate(context.get(), bytes, count); }
    std::string hex()
    {
        std::array<unsigned char, EVP_MAX_MD_SIZE> raw{};
        unsigned size = 0;
        EVP_DigestFinal_ex(context.get(), raw.data(), &size);
        static constexpr char kDigits[] = "0123456789abcdef";
        std::string text;
        for (unsigned n = 0; n < size; ++n) {
            text += kDigits[raw[n] >> 4];
            text += kDigits[raw[n] & 15];
        }
        return text;
    }
};

}  // namespace

void replaceFile(const fs::path& target, const std::function<void(const fs::path&)>& write)
{
    const fs::path temporary = temporaryNameFor(target);
    try {
        write(temporary);
        if (::chmod(temporary.c_str(), fileModeIn(target.parent_path())) != 0)
            failed("cannot be written", target);
        flush(temporary);
        if (::rename(temporary.c_str(), target.c_str()) != 0)
            failed("cannot be replaced", target);
    } catch (...) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        throw;
    }
    flush(target.has_parent_path() ? target.parent_path() : fs::path("."));
}

void replaceFile(const fs::path& target, std::string_view content)
{
    replaceFile(target, [&](const fs::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out.write(content.data(), std::streamsize(content.size()));
        out.close();
        if (!out)
            failed("cannot be written", target);
    });
}

int flushToDisk(const fs::path& path)
{
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const int number = descriptor >= 0 && ::fsync(descriptor) == 0 ? 0 : errno;
    if (descriptor >= 0)
        ::close(descriptor);
    return number;
}

void removeTemporaries(const fs::path& folder)
{
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (entry.path().filename().string().starts_with(kTemporaryPrefix))
            fs::remove_all(entry.path(), ignored);
}

void makePrivateFolder(const fs::path& folder)
{
    if (folder.empty() || fs::is_directory(folder))
        return;
    makePrivateFolder(folder.parent_path());
    if (const int number = makeFolder(folder); number != 0 && number != EEXIST)
        failed("folder cannot be created", folder);
    flush(folder.has_parent_path() ? folder.parent_path() : fs::path("."));
}

namespace {

/// A stream that ends at a fault of the disk is no shorter file.
void requireWhole(const std::ifstream& in, const fs::path& file)
{
    if (in.bad())
        throw Error(ErrorCode::store, "cannot be read to its end", file.string(), "see whether the disk is sound");
}

}  // namespace

std::string readFile(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw Error(fs::exists(file) ? ErrorCode::store : ErrorCode::not_found, "cannot be opened", file.string());
    std::string content;
    std::array<char, 1 << 16> block;
    while (in.read(block.data(), block.size()) || in.gcount() > 0)
        content.append(block.data(), std::size_t(in.gcount()));
    requireWhole(in, file);
    return content;
}

std::string sha256(std::string_view bytes)
{
    Digest digest;
    digest.add(bytes.data(), bytes.size());
    return digest.hex();
}

std::string sha256OfFile(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw Error(ErrorCode::not_found, "cannot be opened", file.string());
    Digest digest;
    std::array<char, 1 << 16> block;
    while (in.read(block.data(), block.size()) || in.gcount() > 0)
        digest.add(block.data(), std::size_t(in.gcount()));
    requireWhole(in, file);
    return digest.hex();
}

std::string nowUtc()
{
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text.data();
}

}  // namespace vicon
