#include "vicon/pipeline/corrections.h"

#include <string>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/core/point_json.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon::pipeline {
namespace {

constexpr const char* kFile = "corrections.json";

void append(Config& config, const std::string& key, const std::vector<Point3>& points)
{
    if (points.empty())
        return;
    json all = config.at(key).value;
    for (const Point3 p : points)
        all.push_back(p);
    config.set(key + "=" + all.dump());
}

}  // namespace

json toJson(const Corrections& corrections)
{
    return {{"add", corrections.add}, {"cut", corrections.cut}, {"drop", corrections.drop}};
}

Corrections readCorrections(const fs::path& scan_folder)
{
    const fs::path file = scan_folder / kFile;
    if (!fs::exists(file))
        return {};
    try {
        const json all = json::parse(readFile(file));
        const auto points = [&](const char* name) {
            return all.value(name, json::array()).get<std::vector<Point3>>();
        };
        return {points("add"), points("cut"), points("drop")};
    } catch (const json::exception&) {
        throw Error(ErrorCode::bad_input, "these corrections cannot be understood", file.string(),
                    "take them back with 'vicon work --case CASE --forget-corrections'");
    }
}

void writeCorrections(const fs::path& scan_folder, const Corrections& corrections)
{
    const fs::path file = scan_folder / kFile;
    if (corrections.empty()) {
        std::error_code missing;
        fs::remove(file, missing);
        return;
    }
    replaceFile(file, toJson(corrections).dump(2) + "\n");
}

Config withCorrections(Config config, const Corrections& corrections)
{
    append(config, "segment.add", corrections.add);
    append(config, "segment.cut", corrections.cut);
    append(config, "segment.drop", corrections.drop);
    return config;
}

}  // namespace vicon::pipeline
