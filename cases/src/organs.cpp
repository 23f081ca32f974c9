#include "vicon/cases/organs.h"

#include "vicon/cases/step_results.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/json_text.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon {
namespace {

constexpr const char* kFile = "organ.json";

}  // namespace

std::optional<Organ> readOrgan(const fs::path& scan_folder)
{
    const fs::path file = scan_folder / kFile;
    if (!fs::exists(file))
        return std::nullopt;
    const json said = parsedJson(readFile(file));
    if (!said.is_object() || !said.value("organ", json()).is_string())
        throw Error(ErrorCode::bad_input, "this does not name an organ", file.string(),
                    "name it again with 'vicon work --organ NAME --case CASE'");
    return Organ(said["organ"].get<std::string>());
}

void writeOrgan(const fs::path& scan_folder, const Organ& organ)
{
    replaceFile(scan_folder / kFile, json{{"organ", organ.name()}}.dump(2) + "\n");
}

Organ organOf(CaseStore& store, const ScanRecord& scan)
{
    return resultsOf(store.steps(scan.case_id, scan.id)).organ();
}

}  // namespace vicon
