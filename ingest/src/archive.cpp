#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <fstream>

#include "input_files.h"
#include "vicon/core/error.h"
#include "vicon/core/printable.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr double kBytesPerGb = 1e9;
constexpr std::size_t kBlockBytes = 1 << 16;
/// CT packs to a half or a third, and empty phantoms to a hundredth; what is packed a thousandfold was made to fill
/// disks.
constexpr double kLargestRatio = 200;
/// The archives of an import may unpack to this whatever their own size.
constexpr double kSmallArchiveBytes = 100e6;

struct ReadArchive {
    archive* handle = archive_read_new();
    ReadArchive() { archive_read_support_format_zip(handle); }
    ~ReadArchive() { archive_read_free(handle); }
    ReadArchive(const ReadArchive&) = delete;
    ReadArchive& operator=(const ReadArchive&) = delete;
    std::string trouble() const
    {
        const char* text = archive_error_string(handle);
        return text ? text : "unknown trouble";
    }
};

bool leadsOut(const std::string& name)
{
    if (name.starts_with('/') || name.starts_with('\\') || (name.size() > 1 && name[1] == ':'))
        return true;
    std::size_t from = 0;
    while (from <= name.size()) {
        const std::size_t to = std::min(name.find_first_of("/\\", from), name.size());
        if (name.substr(from, to - from) == "..")
            return true;
        from = to + 1;
    }
    return false;
}

/// Why an entry is not taken; empty when it is.
std::string whyNot(archive_entry* entry, const std::string& name)
{
    if (leadsOut(name))
        return "its name leads out of the archive's folder";
    if (archive_entry_filetype(entry) != AE_IFREG || archive_entry_hardlink(entry) || archive_entry_symlink(entry))
        return "no plain file (a link or a device)";
    if (archive_entry_is_encrypted(entry))
        return "encrypted: unpack the archive with its password and import the folder";
    return {};
}

/// As it stands in the archive, in whatever character set; the archive's library knows one form or the other.
std::string nameOf(archive_entry* entry)
{
    if (const char* name = archive_entry_pathname(entry))
        return name;
    const char* name = archive_entry_pathname_utf8(entry);
    return name ? name : "(a name that cannot be read)";
}

/// What an archive may unpack to: as much as the options say, and no more than its size, with that of those before it,
/// makes believable. A thousand small ones may not fill what one may not.
class Allowance {
public:
    Allowance(const fs::path& zip, UnpackFolder::Bytes& bytes, const ImportOptions& options) : bytes_(bytes)
    {
        std::error_code unknown;
        const double packed_bytes = double(fs::file_size(zip, unknown));
        bytes_.packed += unknown ? 0 : packed_bytes;
        const double believable_bytes = std::max(kSmallArchiveBytes, bytes_.packed * kLargestRatio) - bytes_.unpacked;
        by_size_ = believable_bytes < options.archive_max_gb * kBytesPerGb;
        left_ = by_size_ ? believable_bytes : options.archive_max_gb * kBytesPerGb;
    }
    bool take(double bytes)
    {
        bytes_.unpacked += bytes;
        left_ -= bytes;
        return left_ >= 0;
    }
    const char* whyExceeded() const
    {
        return by_size_ ? "unpacks to more than 200 times its size; the rest is left out"
                        : "unpacks to more than import.archive_max_gb allows; the rest is left out";
    }

private:
    UnpackFolder::Bytes& bytes_;
    bool by_size_ = false;
    double left_ = 0;
};

enum class Written { complete, damaged, too_large };

Written writeEntry(archive* from, const fs::path& file, Allowance& allowance, Progress& progress)
{
    std::ofstream out(file, std::ios::binary);
    std::vector<char> block(kBlockBytes);
    for (;;) {
        progress.check();
        const la_ssize_t count = archive_read_data(from, block.data(), block.size());
        if (count < 0)
            return Written::damaged;
        if (count == 0)
            break;
        if (!allowance.take(double(count)))
            return Written::too_large;
        out.write(block.data(), count);
    }
    out.close();
    if (!out)
        throw Error(ErrorCode::store, "an archive cannot be unpacked", file.string(), "free some space on this disk");
    return Written::complete;
}

}  // namespace

std::vector<InputFile> unpackZip(const InputFile& zip, UnpackFolder& folder, const ImportOptions& options,
                                 Progress& progress, std::vector<ImportLine>& lines)
{
    std::vector<InputFile> files;
    const auto refuse = [&](const std::string& subject, const std::string& why) {
        lines.push_back({ImportLine::Kind::refused, subject, why, {}, {}});
    };
    ReadArchive in;
    if (archive_read_open_filename(in.handle, zip.path.c_str(), kBlockBytes) != ARCHIVE_OK) {
        refuse(zip.shown, "the zip file cannot be opened (" + in.trouble() + ")");
        return files;
    }
    Allowance allowance(zip.path, folder.bytes(), options);
    archive_entry* entry = nullptr;
    int status = ARCHIVE_OK;
    for (int count = 0;
         (status = archive_read_next_header(in.handle, &entry)) == ARCHIVE_OK || status == ARCHIVE_WARN;) {
        progress.check();
        const std::string name = nameOf(entry);
        const std::string shown = zip.shown + ": " + printable(name);
        if (archive_entry_filetype(entry) == AE_IFDIR)
            continue;
        if (++count > options.archive_max_files) {
            refuse(zip.shown, "holds more files than import.archive_max_files allows; the rest is left out");
            return files;
        }
        if (const std::string why = whyNot(entry, name); !why.empty()) {
            refuse(shown, why);
            continue;
        }
        const fs::path file = folder.nextFile();
        const Written written = writeEntry(in.handle, file, allowance, progress);
        if (written == Written::too_large) {
            refuse(zip.shown, allowance.whyExceeded());
            return files;
        }
        if (written == Written::damaged)
            refuse(shown, "damaged in the archive (" + in.trouble() + ")");
        else
            files.push_back({file, shown, true});
    }
    if (status == ARCHIVE_FATAL)
        refuse(zip.shown, "the zip file is damaged (" + in.trouble() + "); what stands before is taken");
    return files;
}

}  // namespace vicon::ingest
