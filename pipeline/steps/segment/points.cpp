#include "segment/points.h"

#include <cmath>
#include <set>

#include "vicon/core/nearest_voxel.h"

namespace vicon::steps {
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
