#include "segment/points.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "vicon/core/error.h"
#include "vicon/core/nearest_voxel.h"

namespace vicon::steps {
std::vector<Point3> parsePoints(const std::string& text, const std::string& option)
{
    std::vector<Point3> points;
    std::istringstream list(text);
    for (std::string entry; std::getline(list, entry, ';');) {
        if (entry.find_first_not_of(" \t") == std::string::npos)
            continue;
        std::istringstream in(entry);
        Point3 p;
        char comma = 0, other = 0;
        if (!(in >> p.x >> comma >> p.y >> other >> p.z) || comma != ',' || other != ',' || in >> comma)
            throw Error(ErrorCode::wrong_use, "'" + entry + "' is not a point", option,
                        "give points as x,y,z in mm, separated by semicolons");
        points.push_back(p);
    }
    return points;
}

std::string textOf(Point3 point)
{
    const auto whole = [](double mm) { return std::to_string(std::lround(mm)); };
    return whole(point.x) + "," + whole(point.y) + "," + whole(point.z);
}

std::vector<int> componentsAt(const RunLabels& labels, const Grid& grid, const std::vector<Point3>& points)
{
    std::set<int> found;
    for (const Point3 p : points)
        if (const auto nearest = nearestVoxel(grid, p, kCatch_mm, [&](Index3 v) { return labels.labelAt(v) >= 0; }))
            found.insert(labels.labelAt(nearest->voxel));
    return {found.begin(), found.end()};
}

}  // namespace vicon::steps
