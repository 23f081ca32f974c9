#include "vicon/pipeline/corrections.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon::pipeline {
namespace {

constexpr const char* kFile = "corrections.json";

json listOf(const std::vector<Point3>& points)
{
    json list = json::array();
    for (const Point3 p : points)
        list.push_back({p.x, p.y, p.z});
    return list;
}

std::vector<Point3> pointsIn(const json& all, const char* name)
{
    std::vector<Point3> points;
    for (const json& p : all.value(name, json::array()))
        points.push_back({p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>()});
    return points;
}

/// "x,y,z;x,y,z", to a micrometre.
std::string textOf(const std::vector<Point3>& points)
{
    std::string text;
    for (const Point3 p : points) {
        char buffer[128];
        std::snprintf(buffer, sizeof buffer, "%s%.3f,%.3f,%.3f", text.empty() ? "" : ";", p.x, p.y, p.z);
        text += buffer;
    }
    return text;
}

void append(Config& config, const std::string& key, const std::vector<Point3>& points)
{
    if (points.empty())
        return;
    const std::string before = config.at(key).value.get<std::string>();
    config.set(key + "=" + before + (before.empty() ? "" : ";") + textOf(points));
}

}  // namespace

json toJson(const Corrections& corrections)
{
    return {{"add", listOf(corrections.add)}, {"cut", listOf(corrections.cut)}, {"drop", listOf(corrections.drop)}};
}

Corrections readCorrections(const fs::path& scan_folder)
{
    const fs::path file = scan_folder / kFile;
    if (!fs::exists(file))
        return {};
    try {
        const json all = json::parse(readFile(file));
        return {pointsIn(all, "add"), pointsIn(all, "cut"), pointsIn(all, "drop")};
    } catch (const json::exception&) {
        throw Error(ErrorCode::bad_input, "these corrections cannot be understood", file.string(),
                    "take them back with 'vicon work --case CASE --undo-corrections'");
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
