#include "input_files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <set>

#include "dataset.h"
#include "helper.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/file_modes.h"
#include "vicon/core/printable.h"
#include "vicon/dicom/dicom_setup.h"
#include "vicon/dicom/load_file.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

std::string inCase(std::string text, int (*change)(int))
{
    std::transform(text.begin(), text.end(), text.begin(), [&](unsigned char c) { return char(change(c)); });
    return text;
}

bool isDicomdirName(const fs::path& file)
{
    return inCase(file.filename().string(), std::tolower) == "dicomdir";
}

void addRefusal(std::vector<ImportLine>& lines, const std::string& subject, const std::string& why)
{
    lines.push_back({ImportLine::Kind::refused, printable(subject), printable(why), {}, {}});
}

void refuseUnseen(std::vector<ImportLine>& lines, const fs::path& path, const std::error_code& failure)
{
    addRefusal(lines, path.string(), "it cannot be looked at (" + failure.message() + ")");
}

/// The file that a DICOMDIR means; file systems of discs change the case of names. Empty when there is none, or there
/// can be none of that name.
fs::path referencedFile(const fs::path& folder, const std::vector<std::string>& components)
{
    for (const std::string& component : components)
        if (component.empty() || component == "." || component == ".." || component.find('/') != std::string::npos)
            return {};
    for (int (*change)(int) :
         {+[](int c) { return c; }, +[](int c) { return std::tolower(c); }, +[](int c) { return std::toupper(c); }}) {
        fs::path file = folder;
        for (const std::string& component : components)
            file /= inCase(component, change);
        if (std::error_code failure; fs::is_regular_file(file, failure))
            return file;
    }
    return {};
}

void readDicomdir(const fs::path& dicomdir, std::vector<InputFile>& files, std::vector<ImportLine>& lines)
{
    DcmFileFormat format;
    if (loadFile(format, dicomdir).bad())
        return addRefusal(lines, dicomdir.string(), "the DICOMDIR is damaged; import its folder instead");
    const Dataset dataset(*format.getDataset());
    std::set<fs::path> listed;  // a record a file: who names one often would have it read as often
    for (const Dataset& record : dataset.items(DCM_DirectoryRecordSequence)) {
        const auto components = record.values(DCM_ReferencedFileID);
        if (components.empty())
            continue;
        const fs::path file = referencedFile(dicomdir.parent_path(), components);
        std::string named;
        for (const std::string& component : components)
            named += (named.empty() ? "" : "/") + component;
        if (file.empty())
            addRefusal(lines, dicomdir.string(), "names a file that is not there: " + named);
        else if (listed.insert(file).second)
            files.push_back({file, printable(file.string()), false});
    }
}

void listDicomdir(const fs::path& dicomdir, std::vector<InputFile>& files, std::vector<ImportLine>& lines)
{
    setUpDicom();
    if (const std::string why = whyNotToRead(dicomdir); !why.empty())
        return addRefusal(lines, dicomdir.string(), why + "; import its folder instead");
    try {
        readDicomdir(dicomdir, files, lines);
    } catch (const std::exception& e) {  // DCMTK makes texts of values that are not there
        addRefusal(lines, dicomdir.string(),
                   std::string("the DICOMDIR is damaged (") + e.what() + "); import its folder instead");
    }
}

void listFolder(const fs::path& folder, std::vector<InputFile>& files, std::vector<ImportLine>& lines)
{
    std::error_code failure;
    std::vector<fs::path> entries;
    for (auto it = fs::directory_iterator(folder, failure); !failure && it != fs::directory_iterator();
         it.increment(failure))
        entries.push_back(it->path());
    if (failure)
        addRefusal(lines, folder.string(), "the folder cannot be read (" + failure.message() + ")");
    std::sort(entries.begin(), entries.end());
    for (const fs::path& entry : entries) {
        const fs::file_status status = fs::status(entry, failure);
        if (fs::is_directory(status)) {
            if (!fs::is_symlink(fs::symlink_status(entry, failure)))  // a link may lead in circles
                listFolder(entry, files, lines);
        } else if (fs::is_regular_file(status) && !isDicomdirName(entry)) {
            files.push_back({entry, printable(entry.string()), false});
        } else if (status.type() == fs::file_type::none) {
            refuseUnseen(lines, entry, failure);
        }
    }
}

constexpr const char* kUnpackName = "unpack-";
constexpr const char* kUnpackLock = "lock";

/// By an import that lives, on this machine or another one.
bool isHeld(const fs::path& unpack_folder)
{
    const int descriptor = ::open((unpack_folder / kUnpackLock).c_str(), O_RDWR | O_CLOEXEC);
    if (descriptor < 0)
        return false;
    const bool held = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0;
    ::close(descriptor);
    return held;
}

}  // namespace

UnpackFolder::UnpackFolder(const fs::path& incoming)
{
    makePrivateFolder(incoming);
    std::string name = (incoming / (std::string(kTemporaryPrefix) + kUnpackName)).string() + "XXXXXX";
    if (!::mkdtemp(name.data()))
        throw Error(ErrorCode::store, std::string("no folder can be made (") + std::strerror(errno) + ")",
                    incoming.string(), "check that the store is yours, and its disk not full");
    folder_ = name;
    descriptor_ = openOrMake(folder_ / kUnpackLock);
    if (descriptor_ >= 0)
        ::flock(descriptor_, LOCK_EX | LOCK_NB);
}

UnpackFolder::~UnpackFolder()
{
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

fs::path UnpackFolder::nextFile()
{
    return folder_ / (std::to_string(count_++) + ".dcm");
}

void UnpackFolder::removeLeftovers(const fs::path& incoming)
{
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(incoming, ignored))
        if (entry.path().filename().string().starts_with(std::string(kTemporaryPrefix) + kUnpackName) &&
            !isHeld(entry.path()))
            fs::remove_all(entry.path(), ignored);
}

std::vector<InputFile> listFiles(const std::vector<fs::path>& paths, std::vector<ImportLine>& lines)
{
    std::vector<InputFile> files;
    for (const fs::path& path : paths) {
        std::error_code failure;
        const fs::file_status status = fs::status(path, failure);
        if (status.type() == fs::file_type::not_found)
            throw Error(ErrorCode::not_found, "no such file or folder", path.string(),
                        "check the spelling of the path");
        if (!fs::exists(status))
            refuseUnseen(lines, path, failure);
        else if (fs::is_directory(status))
            listFolder(path, files, lines);
        else if (!fs::is_regular_file(status))
            addRefusal(lines, path.string(), "neither a file nor a folder");
        else if (isDicomdirName(path))
            listDicomdir(path, files, lines);
        else
            files.push_back({path, printable(path.string()), false});
    }
    return files;
}

}  // namespace vicon::ingest
