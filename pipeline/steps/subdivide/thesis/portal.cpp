#include "subdivide/thesis/portal.h"
#include "grid/neighbours.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace vicon::steps {
namespace {

/// A portal of more voxels lies along the lumen rather than across it and is of no use; the largest useful ones, of
/// the caecum in ctc_460, have about 5000.
constexpr std::size_t kMostVoxels = 20000;
/// Path voxels to each side that the local tangent is taken over (the thesis: a few).
constexpr std::size_t kLocalReach = 3;
/// Length of skeleton that the regional tangent is taken over, for oblique planes: about a lumen's width.
constexpr double kRegion_mm = 30;
/// The path may leave a portal and touch it again within so many voxels: a 26-connected path wiggles.
constexpr std::size_t kWiggle = 4;

bool overlap(const CutPlane& a, const CutPlane& b)
{
    return a.low.i <= b.high.i && b.low.i <= a.high.i && a.low.j <= b.high.j && b.low.j <= a.high.j &&
           a.low.k <= b.high.k && b.low.k <= a.high.k;
}

bool alongAxis(Vector3 n)
{
    return std::abs(n.x) + std::abs(n.y) + std::abs(n.z) == 1;
}

}  // namespace

bool intersect(const CutPlane& a, const CutPlane& b)
{
    if (!overlap(a, b))
        return false;
    auto p = a.voxels.begin();
    auto q = b.voxels.begin();
    while (p != a.voxels.end() && q != b.voxels.end()) {
        if (*p == *q)
            return true;
        *p < *q ? ++p : ++q;
    }
    return false;
}

CutPlanes::CutPlanes(const InsideVolume& inside, const Skeleton& skeleton, const Path& path,
                     const SubdivideOptions& options)
    : inside_(inside), skeleton_(skeleton), path_(path), options_(options)
{
}

Vector3 CutPlanes::tangent(std::size_t n, std::size_t reach) const
{
    const std::size_t last = path_.voxels.size() - 1;
    const Index3 a = inside_.grid.indexOf(path_.voxels[n > reach ? n - reach : 0].voxel);
    const Index3 b = inside_.grid.indexOf(path_.voxels[std::min(n + reach, last)].voxel);
    return normalized({double(b.i - a.i), double(b.j - a.j), double(b.k - a.k)});
}

std::optional<CutPlane> CutPlanes::cut(std::size_t n, Vector3 normal) const
{
    const Grid& grid = inside_.grid;
    const Index3 c = grid.indexOf(path_.voxels[n].voxel);
    // A digital plane this thick is the thinnest that no 6-connected way passes.
    const double half = 0.5 * std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
    const auto inPlane = [&](Index3 v) {
        const double d = dot(normal, {double(v.i - c.i), double(v.j - c.j), double(v.k - c.k)});
        return d >= -half && d < half && inside_.valueOr(v, kOutside) != kOutside;
    };
    CutPlane plane{.at = n, .normal = normal, .voxels = {}, .low = c, .high = c};
    std::unordered_set<std::uint32_t> seen{std::uint32_t(grid.offset(c))};
    plane.voxels.push_back(std::uint32_t(grid.offset(c)));
    for (std::size_t m = 0; m < plane.voxels.size(); ++m) {
        const Index3 v = grid.indexOf(plane.voxels[m]);
        plane.low = {std::min(plane.low.i, v.i), std::min(plane.low.j, v.j), std::min(plane.low.k, v.k)};
        plane.high = {std::max(plane.high.i, v.i), std::max(plane.high.j, v.j), std::max(plane.high.k, v.k)};
        forEachInCube(v, 1, [&](Index3 w) {
            if (inPlane(w) && seen.insert(std::uint32_t(grid.offset(w))).second)
                plane.voxels.push_back(std::uint32_t(grid.offset(w)));
        });
        if (plane.voxels.size() > kMostVoxels)
            return std::nullopt;
    }
    std::sort(plane.voxels.begin(), plane.voxels.end());
    return plane;
}

bool CutPlanes::cutsPathOnce(const CutPlane& plane) const
{
    const auto& voxels = path_.voxels;
    const auto holds = [&](std::size_t n) {
        return std::binary_search(plane.voxels.begin(), plane.voxels.end(), std::uint32_t(voxels[n].voxel));
    };
    std::size_t first = plane.at, last = plane.at;
    for (std::size_t n = 0; n < voxels.size(); ++n) {
        if (!holds(n))
            continue;
        if (n + kWiggle < first || n > last + kWiggle)
            return false;
        first = std::min(first, n);
        last = std::max(last, n);
    }
    if (first == 0 || last + 1 >= voxels.size())
        return false;
    const Index3 c = inside_.grid.indexOf(voxels[plane.at].voxel);
    const auto side = [&](std::size_t n) {
        const Index3 v = inside_.grid.indexOf(voxels[n].voxel);
        return dot(plane.normal, {double(v.i - c.i), double(v.j - c.j), double(v.k - c.k)});
    };
    return side(first - 1) * side(last + 1) < 0;
}

double CutPlanes::gateRatio(const CutPlane& plane) const
{
    const Grid& grid = inside_.grid;
    if (alongAxis(plane.normal)) {
        std::array<double, 3> side{(plane.high.i - plane.low.i + 1) * grid.spacing_mm[0],
                                   (plane.high.j - plane.low.j + 1) * grid.spacing_mm[1],
                                   (plane.high.k - plane.low.k + 1) * grid.spacing_mm[2]};
        const std::size_t across = plane.normal.x != 0 ? 0 : plane.normal.y != 0 ? 1 : 2;
        return side[(across + 1) % 3] / side[(across + 2) % 3];
    }
    // The sides of an oblique gate: the spread of the portal along the two main directions of the plane.
    const Vector3 u =
        normalized(std::abs(plane.normal.z) < 0.9 ? cross(plane.normal, {0, 0, 1}) : cross(plane.normal, {1, 0, 0}));
    const Vector3 v = cross(plane.normal, u);
    double su = 0, sv = 0, uu = 0, uv = 0, vv = 0;
    for (const std::uint32_t offset : plane.voxels) {
        const Index3 n = grid.indexOf(offset);
        const Vector3 p{double(n.i), double(n.j), double(n.k)};
        const double a = dot(p, u), b = dot(p, v);
        su += a;
        sv += b;
        uu += a * a;
        uv += a * b;
        vv += b * b;
    }
    const auto count = double(plane.voxels.size());
    uu = uu / count - su * su / (count * count);
    vv = vv / count - sv * sv / (count * count);
    uv = uv / count - su * sv / (count * count);
    const double mean = (uu + vv) / 2, root = std::hypot((uu - vv) / 2, uv);
    return std::sqrt((mean + root) / std::max(mean - root, 1e-3));
}

void CutPlanes::rate(std::vector<CutPlane>& planes) const
{
    std::size_t smallest = kMostVoxels;
    for (const CutPlane& plane : planes)
        smallest = std::min(smallest, plane.voxels.size());
    for (CutPlane& plane : planes) {
        plane.ratio = gateRatio(plane);
        const double along = std::abs(dot(plane.normal, tangent(plane.at, kLocalReach)));
        if (options_.effectiveness == PortalEffectiveness::gate_ratio) {
            plane.badness = std::abs(std::log(plane.ratio));
            plane.good = plane.ratio >= options_.gate_ratio_low && plane.ratio <= options_.gate_ratio_high;
        } else if (options_.effectiveness == PortalEffectiveness::tangent) {
            // The plane across the tangent's largest component; no angle to an axis' direction exceeds 54.7 degrees.
            plane.badness = 1 - along;
            plane.good = along > 1 / std::sqrt(3.0);
        } else {
            const double width_mm = 2 * skeleton_.at(path_.voxels[plane.at].station_mm).radius_mm;
            plane.badness = double(plane.voxels.size()) * inside_.grid.spacing_mm[0] * inside_.grid.spacing_mm[1] /
                            std::max(width_mm * width_mm, 1.0);
            plane.good = plane.voxels.size() == smallest;
        }
    }
}

std::vector<CutPlane> CutPlanes::at(std::size_t n) const
{
    std::vector<Vector3> normals{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    if (options_.planes == PlaneDirections::oblique) {
        const Vector3 t = skeleton_.tangentAt(path_.voxels[n].station_mm, kRegion_mm);
        const auto& axis = inside_.grid.axis;
        normals = {normalized({dot(t, axis[0]), dot(t, axis[1]), dot(t, axis[2])})};
    }
    std::vector<CutPlane> planes;
    for (const Vector3& normal : normals)
        if (auto plane = cut(n, normal); plane && cutsPathOnce(*plane))
            planes.push_back(std::move(*plane));
    rate(planes);
    return planes;
}

}  // namespace vicon::steps
