#include "vicon/pipeline/corrections.h"

#include <cstdio>
#include <string>

namespace vicon::pipeline {
namespace {

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

Config withCorrections(Config config, const Corrections& corrections)
{
    append(config, "segment.add", corrections.add);
    append(config, "segment.cut", corrections.cut);
    append(config, "segment.drop", corrections.drop);
    return config;
}

}  // namespace vicon::pipeline
