#include "vicon/steps/exit_distance.h"

#include <algorithm>
#include <cmath>

#include "grid/lumen_front.h"
#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

/// Length of the pieces of skeleton that tell a contact from the way on: a front passes between parts of the lumen
/// whose pieces are at most LumenFront::kSpan apart. Chosen on the shapes ctc_460 and EdinGCA_3D_00060, whose
/// flexures are passed freely.
constexpr double kPieceLength_mm = 20;

/// How many voxels of a separate part are asked for their distance to the skeleton.
constexpr std::size_t kProbes = 2000;

/// A front through a contact arrives from both sides, so the distance falls somewhere along the skeleton, by nearly as
/// much as the short cut saves. A fall of this much is more than a curve's own wiggling makes.
constexpr double kFall_mm = 10;

using Labels = LumenFront::Labels;

/// Labels every inside voxel with the piece of skeleton whose front reaches it first, 1 for the rectal end.
void labelByPieces(LumenFront& front, const InsideVolume& inside, const Skeleton& skeleton)
{
    const double step_mm = 0.5 * *std::min_element(inside.grid.spacing_mm.begin(), inside.grid.spacing_mm.end());
    int first_label = 1;
    for (const SkeletonPiece& piece : skeleton.pieces) {
        if (piece.bridge)
            continue;
        const double from = piece.points.front().station_mm, length = piece.points.back().station_mm - from;
        const int pieces = std::max(1, int(std::lround(length / kPieceLength_mm)));
        const int samples = std::max(1, int(std::ceil(length / step_mm)));
        for (int n = 0; n <= samples; ++n) {
            const double along = length * n / samples;
            const Index3 v = inside.grid.indexAt(skeleton.at(from + along).position_mm);
            const int label = first_label + std::min(pieces - 1, int(pieces * along / std::max(length, 1e-9)));
            if (inside.valueOr(v, kOutside))
                front.seed(inside.grid.offset(v), 0, std::uint16_t(std::min(label, 65535)));
        }
        front.seed(nearestInside(inside, piece.points.front().position_mm), 0, std::uint16_t(first_label));
        first_label += pieces;
    }
    front.run(Labels::adopt);
    front.runOverCorners(Labels::adopt);
}

/// Gives what nothing joins to the skeleton the value of the voxel at the nearest skeleton point plus the way there.
void reachSeparateParts(LumenFront& front, const InsideVolume& inside, const Skeleton& skeleton, Labels labels)
{
    for (std::vector<std::uint32_t> left = front.unreached(); !left.empty();) {
        std::uint32_t nearest = left.front();
        SkeletonFoot foot{.distance_mm = 1e300};
        const auto component = front.componentOf(left.front());
        for (std::size_t n = 0; n < component.size(); n += component.size() / kProbes + 1)
            if (const auto f = skeleton.nearest(inside.grid.pointAt(inside.grid.indexOf(component[n])));
                f.distance_mm < foot.distance_mm) {
                foot = f;
                nearest = component[n];
            }
        const std::size_t anchor = nearestInside(inside, foot.position_mm);
        const float at_anchor = front.timeAt(anchor);
        const double start_mm = at_anchor < LumenFront::kUnreached ? double(at_anchor) : foot.station_mm;
        if (labels == Labels::ignore)
            front.seed(nearest, float(start_mm + foot.distance_mm));
        else
            front.seed(nearest, float(start_mm + foot.distance_mm), front.labelAt(anchor));
        front.run(labels);
        front.runOverCorners(labels);
        std::erase_if(left, [&](std::uint32_t v) { return front.timeAt(v) < LumenFront::kUnreached; });
    }
}

/// Starts the front at the rectal end: straight distances in the ball that the curve's first point has around it,
/// where upwind differences from a single voxel would be at their worst.
void seedExit(LumenFront& front, const InsideVolume& inside, const SkeletonPoint& end)
{
    const Grid& grid = inside.grid;
    const std::size_t start = nearestInside(inside, end.position_mm);
    const Index3 c = grid.indexOf(start);
    front.seed(start, 0);
    const double voxel_mm = *std::max_element(grid.spacing_mm.begin(), grid.spacing_mm.end());
    const double radius_mm = end.radius_mm - 2 * voxel_mm;
    const int reach = int(std::max(0.0, radius_mm) / *std::min_element(grid.spacing_mm.begin(), grid.spacing_mm.end()));
    for (int k = c.k - reach; k <= c.k + reach; ++k)
        for (int j = c.j - reach; j <= c.j + reach; ++j)
            for (int i = c.i - reach; i <= c.i + reach; ++i)
                if (const Index3 v{i, j, k}; grid.contains(v))
                    if (const double d = distance(grid.pointAt(v), grid.pointAt(c)); d <= radius_mm)
                        front.seed(grid.offset(v), float(d));
}

/// Carries the distance over the bridges, in both directions, until no bridge shortens anything.
void crossBridges(LumenFront& front, const InsideVolume& inside, const Skeleton& skeleton, Labels labels)
{
    struct Bridge {
        std::size_t from, to;
        float length_mm;
    };
    std::vector<Bridge> bridges;
    for (const SkeletonPiece& piece : skeleton.pieces)
        if (piece.bridge)
            bridges.push_back({nearestInside(inside, piece.points.front().position_mm),
                               nearestInside(inside, piece.points.back().position_mm),
                               float(piece.points.back().station_mm - piece.points.front().station_mm)});
    for (bool changed = true; changed;) {
        changed = false;
        for (const Bridge& bridge : bridges)
            for (const auto& [a, b] : {std::pair(bridge.from, bridge.to), std::pair(bridge.to, bridge.from)}) {
                const float at = front.timeAt(a);
                if (at == LumenFront::kUnreached || at + bridge.length_mm >= front.timeAt(b))
                    continue;
                front.seed(b, at + bridge.length_mm);
                front.run(labels);
                changed = true;
            }
    }
}

void march(LumenFront& front, const InsideVolume& inside, const Skeleton& skeleton, Labels labels)
{
    seedExit(front, inside, skeleton.pieces.front().points.front());
    front.run(labels);
    crossBridges(front, inside, skeleton, labels);
    front.runOverCorners(labels);
    reachSeparateParts(front, inside, skeleton, labels);
}

bool tookShortCut(const LumenFront& front, const InsideVolume& inside, const Skeleton& skeleton)
{
    double most = 0;
    for (const SkeletonPiece& piece : skeleton.pieces)
        for (const SkeletonPoint& point : piece.points) {
            const Index3 v = inside.grid.indexAt(point.position_mm);
            if (piece.bridge || inside.valueOr(v, kOutside) == kOutside)
                continue;
            const double here = front.timeAt(inside.grid.offset(v));
            most = std::max(most, here);
            if (here < most - kFall_mm)
                return true;
        }
    return false;
}

}  // namespace

FieldVolume exitDistance(const InsideVolume& inside, const Skeleton& skeleton, Progress& progress)
{
    if (skeleton.empty())
        throw Error(ErrorCode::bad_input, "the skeleton is empty");
    progress.report(0, "exit distance");
    LumenFront front(inside);
    march(front, inside, skeleton, Labels::ignore);
    progress.check();
    if (tookShortCut(front, inside, skeleton)) {
        progress.report(0.4, "exit distance");
        front.restart();
        labelByPieces(front, inside, skeleton);
        reachSeparateParts(front, inside, skeleton, Labels::adopt);
        progress.check();
        progress.report(0.7, "exit distance");
        front.restart();
        march(front, inside, skeleton, Labels::fixed);
        progress.check();
    }
    progress.report(1, "exit distance");
    return front.times();
}

FieldVolume exitDistance(const InsideVolume& inside, const SkeletonTree& tree, Progress& progress)
{
    if (tree.empty())
        throw Error(ErrorCode::bad_input, "the skeleton is empty");
    progress.report(0, "exit distance");
    LumenFront front(inside);
    march(front, inside, tree.allBranches(), Labels::ignore);
    progress.report(1, "exit distance");
    return front.times();
}

}  // namespace vicon::steps
