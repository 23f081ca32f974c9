#include "vicon/scan_files/description_file.h"

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/json_text.h"

namespace fs = std::filesystem;

namespace vicon::scan_files {
namespace {

constexpr const char* kFile = "scan.json";

std::string textOf(const nlohmann::json& description)
{
    return description.dump(2) + "\n";
}

}  // namespace

void writeDescription(const fs::path& scan_folder, const nlohmann::json& description)
{
    replaceFile(scan_folder / kFile, textOf(description));
}

bool isDescribedBy(const fs::path& scan_folder, const nlohmann::json& description)
{
    return fs::exists(scan_folder / kFile) && readFile(scan_folder / kFile) == textOf(description);
}

nlohmann::json readDescription(const fs::path& scan_folder)
{
    const fs::path file = scan_folder / kFile;
    if (!fs::exists(file))
        return nlohmann::json::object();
    auto description = parsedJson(readFile(file));
    if (!description.is_object())
        throw Error(ErrorCode::bad_input, "is not the description of a scan", file.string(), "run 'vicon work'");
    return description;
}

}  // namespace vicon::scan_files
