#include "trial_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "vicon/core/file.h"
#include "vicon/core/json_text.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon::ingest {
namespace {

constexpr const char* kName = "being_taken.json";
constexpr int kMostCounted = 1000;

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
    if (!fs::exists(folder / kName))
        return {};
    try {
        const json content = parsedJson(readFile(folder / kName));
        Trial trial;
        for (const json& file : content.at("files"))
            trial.files.push_back(folder / file.get<std::string>());
        trial.deaths = std::clamp(wholeNumber(content.at("deaths")), 0, kMostCounted) + 1;
        return trial;
    } catch (const json::exception&) {  // not as VICON writes it: it tells nothing
        return {};
    }
}

}  // namespace vicon::ingest
