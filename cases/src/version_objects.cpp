#include "version_objects.h"

#include <future>

#include "vicon/cases/report_files.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

/// Empty where it is as it was kept.
std::string faultOfObject(const fs::path& file, const std::string& sha256)
{
    const std::string name = file.filename().string();
    if (!fs::exists(file))
        return name + " is missing";
    return sha256OfFile(file) == sha256 ? "" : name + " is not what was kept";
}

}  // namespace

std::optional<ObjectHashes> objectHashesFrom(const std::string& column)
{
    if (column.empty())
        return std::nullopt;
    return nlohmann::json::parse(column).get<ObjectHashes>();
}

ObjectHashes hashesOf(const std::vector<fs::path>& files)
{
    ObjectHashes hashes;
    for (const fs::path& file : files)
        hashes[file.filename().string()] = sha256OfFile(file);
    return hashes;
}

std::string faultOfObjects(const ReportVersion& version)
{
    std::string all;
    for (const auto& [name, sha256] : version.objects.value_or(ObjectHashes()))
        if (const std::string fault = faultOfObject(version.file.parent_path() / name, sha256); !fault.empty())
            all += (all.empty() ? "" : "; ") + fault;
    return all;
}

std::vector<fs::path> requireObjects(const ReportVersion& version)
{
    const fs::path folder = version.file.parent_path();
    if (!version.objects)
        return versionObjectsIn(folder, version.version);
    if (const std::string fault = faultOfObjects(version); !fault.empty())
        throw Error(ErrorCode::store, "the signed report is not as it was: " + fault, folder.string(),
                    "put back what a backup holds of it");
    std::vector<fs::path> files;
    for (const auto& [name, sha256] : *version.objects)
        files.push_back(folder / name);
    return files;
}

/// All at once: the disk flushes many files in the time of one.
void putObjects(const ReportVersion& version, const std::vector<fs::path>& files)
{
    const fs::path folder = version.file.parent_path();
    for (const fs::path& left : versionObjectsIn(folder, version.version))
        fs::remove(left);
    std::vector<std::future<void>> writing;
    for (const fs::path& file : files)
        writing.push_back(
            std::async(std::launch::async, [file, to = folder / file.filename()] { replaceFile(to, readFile(file)); }));
    for (std::future<void>& one : writing)
        one.get();
}

}  // namespace vicon
