#include <algorithm>
#include <cmath>
#include <numbers>

#include "tubes.h"

namespace vicon::phantom {
namespace {

constexpr int kGenerations = 5;
constexpr double kTaper = 0.79;      // of the radius from one generation to the next: Murray's law, two equal children
constexpr double kClear_mm = 4;      // of tissue and lung between branches that are no relatives
constexpr Point3 kCarina{0, 0, 30};  // the scan's middle is the origin

double radians(double degrees)
{
    return degrees * std::numbers::pi / 180;
}

/// The lungs, roughly: where bronchi may go.
bool inLung(Point3 p)
{
    const double x = (std::abs(p.x) - 60) / 50, y = p.y / 65, z = (p.z + 10) / 110;
    return x * x + y * y + z * z < 1;
}

class Drawer {
public:
    explicit Drawer(std::uint64_t seed) : random_(seed, "airway") {}

    SkeletonTree draw()
    {
        const double radius = random_.uniform(7.5, 9), lean = random_.uniform(-4, 4);
        const int trachea =
            addBranch(tree_, -1, {{lean, 6, 138}, {lean / 2, 3, 84}, kCarina}, {radius, radius, radius});
        for (const double side : {-1.0, 1.0}) {  // -1: the patient's right
            const double angle = radians(side < 0 ? random_.uniform(25, 32) : random_.uniform(42, 50));
            const double length = side < 0 ? random_.uniform(26, 32) : random_.uniform(44, 52);
            const Vector3 along{side * std::sin(angle), 0.1, -std::cos(angle)};
            grow(trachea, normalized(along), {0, 1, 0}, length, radius * kTaper);
        }
        return inOrder(tree_);
    }

private:
    void grow(int parent, Vector3 along, Vector3 across, double length_mm, double radius_mm)
    {
        const SkeletonPoint from = tree_.branches[std::size_t(parent)].points.back();
        const int generation = tree_.branches[std::size_t(parent)].generation + 1;
        const Point3 to = from.position_mm + along * length_mm;
        if (generation > 1 && (!inLung(to) || tooNear(parent, from.position_mm, to, radius_mm)))
            return;
        const double end_mm = radius_mm * 0.95;
        const int own = addBranch(tree_, parent, {from.position_mm, to}, {radius_mm, end_mm});
        if (generation == kGenerations)
            return;
        // The next fork lies in the plane across this one's, as in the lung.
        const Vector3 out = normalized(cross(along, across));
        for (const double side : {-1.0, 1.0}) {
            const double angle = radians(random_.uniform(30, 42));
            const Vector3 next = normalized(along * std::cos(angle) + across * (side * std::sin(angle)));
            grow(own, next, out, random_.uniform(3.6, 4.6) * end_mm * kTaper + 6, end_mm * kTaper);
        }
        forkOrNone(own);
    }

    /// A branch with one child would be no fork: the child goes as well.
    void forkOrNone(int parent)
    {
        std::vector<std::size_t> children;
        for (std::size_t n = 0; n < tree_.branches.size(); ++n)
            if (tree_.branches[n].parent == parent)
                children.push_back(n);
        if (children.size() != 1)
            return;
        tree_.branches.resize(children.front());  // what was added last
    }

    bool tooNear(int parent, Point3 from, Point3 to, double radius_mm) const
    {
        for (int n = 1; n <= 10; ++n) {
            const Point3 p = interpolate(from, to, n / 10.0);
            for (std::size_t b = 0; b < tree_.branches.size(); ++b) {
                const SkeletonBranch& other = tree_.branches[b];
                if (int(b) == parent || other.parent == parent || int(b) == tree_.branches[std::size_t(parent)].parent)
                    continue;
                const SkeletonTree one{{other}};
                if (tubesDistance(one, p, 1e9) < radius_mm + kClear_mm)
                    return true;
            }
        }
        return false;
    }

    Random random_;
    SkeletonTree tree_;
};

}  // namespace

SkeletonTree drawAirway(std::uint64_t seed)
{
    return Drawer(seed).draw();
}

double chestHu(Point3 p)
{
    if (std::hypot(p.x / 135, p.y / 100) > 1)
        return -1000;
    const double spine = std::hypot(p.x, p.y - 62);
    if (spine < 17)  // vertebrae of 26 mm with discs between them
        return p.z - 30 * std::floor(p.z / 30) > 26 ? 90 : spine < 15 ? 220 : 600;
    const double ribs = (1 - std::hypot(p.x / 120, p.y / 85)) * 85;
    const bool lung = ribs > 0 && std::abs(p.x) > 24 - 0.08 * p.z && p.z < 110;
    return lung ? -860 : 40;
}

}  // namespace vicon::phantom
