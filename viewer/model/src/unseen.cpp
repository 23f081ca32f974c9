#include "vicon/viewer/model/unseen.h"

#include <algorithm>

#include "vicon/core/disjoint_sets.h"
#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

/// An edge by its two points, and a triangle that has it.
struct Edge {
    std::uint64_t points;
    std::uint32_t triangle;
};

std::vector<Edge> edgesOf(const std::vector<std::uint32_t>& corners, const std::vector<std::uint32_t>& unseen)
{
    std::vector<Edge> edges;
    edges.reserve(3 * unseen.size());
    for (const std::uint32_t t : unseen)
        for (std::size_t n = 0; n < 3; ++n) {
            const std::uint64_t a = corners[3 * std::size_t(t) + n], b = corners[3 * std::size_t(t) + (n + 1) % 3];
            edges.push_back({std::min(a, b) << 32 | std::max(a, b), t});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.points < b.points; });
    return edges;
}

void checkAt(std::size_t n, const Progress* wanted)
{
    constexpr std::size_t kSome = 65536;  // milliseconds
    if (wanted && n % kSome == 0)
        wanted->check();
}

// Unseen triangles by piece, each piece's in ascending order.
std::vector<std::vector<std::uint32_t>> piecesOf(const std::vector<std::uint32_t>& corners, const Coverage& coverage,
                                                 const Progress* wanted)
{
    std::vector<std::uint32_t> unseen;
    for (std::size_t t = 0; t < corners.size() / 3; ++t)
        if (!coverage.seen(t))
            unseen.push_back(std::uint32_t(t));
    DisjointSets joined(corners.size() / 3);
    const std::vector<Edge> edges = edgesOf(corners, unseen);
    for (std::size_t n = 1; n < edges.size(); ++n) {
        checkAt(n - 1, wanted);
        if (edges[n].points == edges[n - 1].points)
            joined.join(edges[n].triangle, edges[n - 1].triangle);
    }
    std::vector<std::vector<std::uint32_t>> pieces;
    std::vector<std::uint32_t> piece_of(corners.size() / 3, 0);
    for (std::size_t n = 0; n < unseen.size(); ++n) {
        checkAt(n, wanted);
        const std::uint32_t t = unseen[n];
        const std::uint32_t root = joined.rootOf(t);
        if (root == t) {  // the first of its piece
            piece_of[t] = std::uint32_t(pieces.size());
            pieces.emplace_back();
        }
        pieces[piece_of[root]].push_back(t);
    }
    return pieces;
}

Point3 middleOf(const std::vector<float>& points_mm, const std::vector<std::uint32_t>& corners, std::uint32_t triangle)
{
    Vector3 sum;
    for (std::size_t n = 0; n < 3; ++n) {
        const float* p = &points_mm[3 * std::size_t(corners[3 * std::size_t(triangle) + n])];
        sum += Vector3{p[0], p[1], p[2]};
    }
    return Point3{} + sum / 3;
}

/// The station of a patch. The whole path's nearest point may be one of a narrow loop behind a wide loop's wall; what
/// is looked at in plain view lies in the same loop as the eye.
double stationOf(const UnseenPatch& patch, const Skeleton& skeleton)
{
    constexpr double kBeside_mm = 20;
    if (!patch.view.sees_target)
        return skeleton.nearest(patch.centre_mm).station_mm;
    const double reach_mm = 2 * distance(patch.view.pose.eye_mm, patch.centre_mm) + kBeside_mm;
    const double eye_mm = patch.view.station_mm;
    return skeleton.nearest(patch.centre_mm, eye_mm - reach_mm, eye_mm + reach_mm).station_mm;
}

void requireSameSurface(const std::vector<std::uint32_t>& triangles, const Coverage& coverage)
{
    if (coverage.triangleCount() != triangles.size() / 3)
        throw Error(ErrorCode::bad_input, "the coverage belongs to a surface of another number of triangles",
                    std::to_string(coverage.triangleCount()));
}

}  // namespace

std::vector<double> unseenAreas_mm2(const std::vector<std::uint32_t>& triangles, const Coverage& coverage,
                                    const Progress* wanted)
{
    requireSameSurface(triangles, coverage);
    std::vector<double> areas_mm2;
    for (const std::vector<std::uint32_t>& piece : piecesOf(triangles, coverage, wanted)) {
        double area_mm2 = 0;
        for (const std::uint32_t t : piece)
            area_mm2 += coverage.area_mm2(t);
        areas_mm2.push_back(area_mm2);
    }
    return areas_mm2;
}

std::vector<UnseenPatch> unseenPatches(const std::vector<float>& points_mm, const std::vector<std::uint32_t>& triangles,
                                       const Coverage& coverage, const Skeleton& skeleton, const PathFrames& path,
                                       const Lumen& lumen, double least_area_mm2, const Progress* wanted)
{
    requireSameSurface(triangles, coverage);
    std::vector<UnseenPatch> patches;
    for (std::vector<std::uint32_t>& piece : piecesOf(triangles, coverage, wanted)) {
        UnseenPatch patch;
        Vector3 moment;
        for (const std::uint32_t t : piece) {
            patch.area_mm2 += coverage.area_mm2(t);
            moment += (middleOf(points_mm, triangles, t) - Point3{}) * coverage.area_mm2(t);
        }
        if (patch.area_mm2 < least_area_mm2 || !(patch.area_mm2 > 0))
            continue;
        const Point3 middle = Point3{} + moment / patch.area_mm2;
        const auto off = [&](std::uint32_t t) { return distance(middleOf(points_mm, triangles, t), middle); };
        patch.centre_mm =
            middleOf(points_mm, triangles,
                     *std::min_element(piece.begin(), piece.end(), [&](auto a, auto b) { return off(a) < off(b); }));
        patch.triangles = std::move(piece);
        patches.push_back(std::move(patch));
    }
    std::stable_sort(patches.begin(), patches.end(),
                     [](const auto& a, const auto& b) { return a.area_mm2 > b.area_mm2; });
    for (UnseenPatch& patch : patches) {
        if (wanted)
            wanted->check();
        patch.view = poseForPoint(skeleton, path, lumen, patch.centre_mm);
        patch.station_mm = stationOf(patch, skeleton);
    }
    return patches;
}

}  // namespace vicon::viewer
