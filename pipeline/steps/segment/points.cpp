#include "segment/points.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

template <class Use>
void forEachWithin(const Grid& grid, Point3 p, double radius_mm, Use use)
{
    const Index3 c = grid.indexAt(p);
    const int reach = int(std::ceil(radius_mm / grid.spacing_mm[0])) + 1;
    for (int k = c.k - reach; k <= c.k + reach; ++k)
        for (int j = c.j - reach; j <= c.j + reach; ++j)
            for (int i = c.i - reach; i <= c.i + reach; ++i)
                if (const Index3 v{i, j, k}; grid.contains(v)) {
                    const double d = distance(grid.pointAt(v), p);
                    if (d <= radius_mm)
                        use(v, d);
                }
}

}  // namespace

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
    for (const Point3 p : points) {
        int label = -1;
        double nearest = 1e300;
        forEachWithin(grid, p, kCatch_mm, [&](Index3 v, double d) {
            const int here = d < nearest ? labels.labelAt(v) : -1;
            if (here >= 0) {
                nearest = d;
                label = here;
            }
        });
        if (label >= 0)
            found.insert(label);
    }
    return {found.begin(), found.end()};
}

}  // namespace vicon::steps
