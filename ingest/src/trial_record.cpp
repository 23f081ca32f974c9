#include "trial_record.h"

#include <nlohmann/json.hpp>
#include <string>

#include "vicon/core/file.h"
#include "vicon/core/json_text.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon::ingest {
namespace {

constexpr const char* kName = "being_taken.json";

}  // namespace

TrialRecord::TrialRecord(const fs::path& folder, const Trial& trial) : file_(folder / kName)
{
    json files = json::array();
    for (const fs::path& file : trial.files)
        files.push_back(fs::relative(file, folder).string());
    replaceFile(file_, json{{"files", files}, {"deaths", trial.deaths}}.dump() + "\n");
}

TrialRecord::~TrialRecord()
{
    std::error_code ignored;
    fs::remove(file_, ignored);
}

Trial readTrial(const fs::path& folder)
{
    Trial trial;
    if (!fs::exists(folder / kName))
        return trial;
    const json content = parsedJson(readFile(folder / kName));
    if (!content.is_object())
        return trial;
    for (const json& file : content.value("files", json::array()))
        trial.files.push_back(folder / file.get<std::string>());
    trial.deaths = content.value("deaths", 0) + 1;
    return trial;
}

}  // namespace vicon::ingest
