#include "vicon/pipeline/corrections.h"

#include <string>

#include "vicon/core/geometry_json.h"

using nlohmann::json;

namespace vicon::pipeline {
namespace {

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

Config withCorrections(Config config, const Corrections& corrections)
{
    append(config, "segment.add", corrections.add);
    append(config, "segment.cut", corrections.cut);
    append(config, "segment.drop", corrections.drop);
    return config;
}

}  // namespace vicon::pipeline
