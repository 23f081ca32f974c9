#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "grid/wall_values.h"
#include "subdivide/contour.h"

namespace vicon::steps {
namespace {

// All chosen on ctc-prone, stations 250, 300, 575 and 600 mm, where folds end near the eye.
/// The middle of an edge that lies farther off the surface is a new point.
constexpr float kOff_voxels = 0.1F;
/// Each halves what is left of a rim's sagitta by four.
constexpr int kDivisions = 2;
/// Edges that are shorter have no middle worth a point.
constexpr float kShortest_voxels = 0.3F;
/// A middle goes no farther: what lies beyond is another surface.
constexpr float kFarthest_voxels = 0.8F;
/// Of the way to the surface: so many steps, none longer than this.
constexpr int kStepsToSurface = 6;
constexpr float kLongestStep_voxels = 0.4F;
/// The slope, of the field's range over a voxel, below which its direction is noise.
constexpr float kLeastFieldSlope = 0.04F;
/// How near to 0 the field is at the end of the way, of its range.
constexpr float kAtSurface = 0.01F;
constexpr float kRange = 2 * kWallScale;

using Spot = std::array<float, 3>;
using CornersOf = std::array<std::uint32_t, 3>;

struct FieldAt {
    float value = 0;
    Spot slope{};  ///< a voxel
};

/// CubicWeights of four voxels in a row for a place between the middle ones, and their derivatives (Catmull and Rom).
struct CubicWeights {
    std::array<float, 4> value, slope;

    explicit CubicWeights(float t)
        : value{((-0.5F * t + 1) * t - 0.5F) * t, (1.5F * t - 2.5F) * t * t + 1, ((-1.5F * t + 2) * t + 0.5F) * t,
                (0.5F * t - 0.5F) * t * t},
          slope{(-1.5F * t + 2) * t - 0.5F, (4.5F * t - 5) * t, (-4.5F * t + 4) * t + 0.5F, (1.5F * t - 1) * t}
    {
    }
};

/// The field between its voxels: smooth, and through their values. E. Catmull and R. Rom, A class of local
/// interpolating splines, in Computer Aided Geometric Design, 1974.
class SmoothField {
public:
    explicit SmoothField(const Volume<std::int16_t>& field) : field_(field) {}

    FieldAt at(const Spot& p) const
    {
        std::array<std::array<std::ptrdiff_t, 4>, 3> offsets{};
        const std::array<CubicWeights, 3> weights{weightsAlong(0, p, offsets), weightsAlong(1, p, offsets),
                                                  weightsAlong(2, p, offsets)};
        FieldAt found;
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t j = 0; j < 4; ++j) {
                const std::int16_t* row = field_.voxels.data() + offsets[2][k] + offsets[1][j];
                float value = 0, slope = 0;
                for (std::size_t i = 0; i < 4; ++i) {
                    const float here = row[offsets[0][i]];
                    value += weights[0].value[i] * here;
                    slope += weights[0].slope[i] * here;
                }
                const float wj = weights[1].value[j], wk = weights[2].value[k];
                found.value += value * wj * wk;
                found.slope[0] += slope * wj * wk;
                found.slope[1] += value * weights[1].slope[j] * wk;
                found.slope[2] += value * wj * weights[2].slope[k];
            }
        return found;
    }

private:
    CubicWeights weightsAlong(std::size_t axis, const Spot& p,
                              std::array<std::array<std::ptrdiff_t, 4>, 3>& offsets) const
    {
        const float low = std::floor(p[axis]);
        const auto [nx, ny, nz] = field_.grid.size;
        const std::ptrdiff_t stride = axis == 0 ? 1 : axis == 1 ? nx : std::ptrdiff_t(nx) * ny;
        const int last = field_.grid.size[axis] - 1;
        for (int n = 0; n < 4; ++n)  // the field begins one voxel before the labels
            offsets[axis][std::size_t(n)] = stride * std::clamp(int(low) + n, 0, last);
        return CubicWeights(p[axis] - low);
    }

    const Volume<std::int16_t>& field_;
};

float lengthOfSpot(const Spot& p)
{
    return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

/// The way to the surface along the slope, as far as that is straight.
Spot stepToSurface(const FieldAt& here)
{
    const float slope = std::max(lengthOfSpot(here.slope), kLeastFieldSlope * kRange);
    const float step = std::clamp(here.value / slope, -kLongestStep_voxels, kLongestStep_voxels) / slope;
    return {-step * here.slope[0], -step * here.slope[1], -step * here.slope[2]};
}

/// The place on the surface that an edge's middle belongs to, where that lies off the edge.
std::optional<Spot> middleOffEdge(const SmoothField& field, const float* a, const float* b)
{
    const Spot along{b[0] - a[0], b[1] - a[1], b[2] - a[2]},
        middle{a[0] + along[0] / 2, a[1] + along[1] / 2, a[2] + along[2] / 2};
    if (lengthOfSpot(along) < kShortest_voxels)
        return {};
    FieldAt here = field.at(middle);
    if (lengthOfSpot(stepToSurface(here)) <= kOff_voxels)
        return {};
    Spot at = middle;
    for (int n = 0; n < kStepsToSurface; ++n) {
        const Spot step = stepToSurface(here);
        for (std::size_t d = 0; d < 3; ++d)
            at[d] += step[d];
        here = field.at(at);
    }
    const float off = lengthOfSpot({at[0] - middle[0], at[1] - middle[1], at[2] - middle[2]});
    if (std::abs(here.value) > kAtSurface * kRange || off <= kOff_voxels || off > kFarthest_voxels)
        return {};
    return at;
}

/// An edge from the lower to the higher point number, and its middle.
struct DividedEdge {
    std::uint32_t a, b;
    Spot middle;
    bool operator<(const DividedEdge& other) const { return std::tie(a, b) < std::tie(other.a, other.b); }
};

std::vector<DividedEdge> edgesOff(const SmoothField& field, const Contour& contour,
                                  const std::vector<std::uint32_t>& triangles)
{
    constexpr std::size_t kAtOnce = 4096;  // triangles a task, for speed alone: parts are joined in order
    std::vector<std::vector<DividedEdge>> parts((triangles.size() + kAtOnce - 1) / kAtOnce, std::vector<DividedEdge>{});
    tbb::parallel_for(std::size_t(0), parts.size(), [&](std::size_t part) {
        for (std::size_t n = part * kAtOnce; n < std::min(triangles.size(), (part + 1) * kAtOnce); ++n)
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t* corners = &contour.triangles[3 * std::size_t(triangles[n])];
                const std::uint32_t a = corners[c], b = corners[(c + 1) % 3];
                if (a > b)  // its other triangle has it the other way round
                    continue;
                const float* points = contour.points.data();
                if (const auto middle = middleOffEdge(field, points + 3 * std::size_t(a), points + 3 * std::size_t(b)))
                    parts[part].push_back({a, b, *middle});
            }
    });
    std::vector<DividedEdge> all;
    for (const auto& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    return all;
}

/// Puts the middles of divided edges into the triangles that have these edges.
class Division {
public:
    Division(const std::vector<DividedEdge>& edges, Contour& contour)
        : edges_(edges), contour_(contour), first_(std::uint32_t(contour.pointCount())), ends_(first_, 0)
    {
        for (const DividedEdge& edge : edges) {
            ends_[edge.a] = ends_[edge.b] = 1;
            contour_.points.insert(contour_.points.end(), edge.middle.begin(), edge.middle.end());
        }
    }

    /// The triangles that came of one; none where no edge of it is divided.
    std::vector<std::uint32_t> divide(std::uint32_t triangle)
    {
        CornersOf corners{}, middles{};
        std::copy_n(&contour_.triangles[3 * std::size_t(triangle)], 3, corners.begin());
        int count = 0;
        for (std::size_t n = 0; n < 3; ++n) {
            middles[n] = middleOf(corners[n], corners[(n + 1) % 3]);
            count += middles[n] != kNone;
        }
        if (count == 0)
            return {};
        // Turned so that the first edge is the only one that is divided, or the only one that is not.
        while (count < 3 && (middles[0] != kNone) != (count == 1)) {
            std::rotate(corners.begin(), corners.begin() + 1, corners.end());
            std::rotate(middles.begin(), middles.begin() + 1, middles.end());
        }
        const auto [a, b, c] = corners;
        const auto [ab, bc, ca] = middles;
        if (count == 1)
            return put(triangle, {CornersOf{a, ab, c}, CornersOf{ab, b, c}});
        if (count == 2)
            return put(triangle, {CornersOf{a, b, bc}, CornersOf{a, bc, ca}, CornersOf{bc, c, ca}});
        return put(triangle, {CornersOf{a, ab, ca}, CornersOf{ab, b, bc}, CornersOf{ca, bc, c}, CornersOf{ab, bc, ca}});
    }

private:
    static constexpr std::uint32_t kNone = ~std::uint32_t(0);  // the edge is not divided

    std::uint32_t middleOf(std::uint32_t p, std::uint32_t q) const
    {
        if (!ends_[p] || !ends_[q])
            return kNone;
        const DividedEdge edge{std::min(p, q), std::max(p, q), {}};
        const auto found = std::lower_bound(edges_.begin(), edges_.end(), edge);
        return found == edges_.end() || edge < *found ? kNone : first_ + std::uint32_t(found - edges_.begin());
    }

    std::vector<std::uint32_t> put(std::uint32_t in_place_of, const std::vector<CornersOf>& parts)
    {
        std::copy(parts[0].begin(), parts[0].end(), &contour_.triangles[3 * std::size_t(in_place_of)]);
        std::vector<std::uint32_t> numbers{in_place_of};
        for (std::size_t n = 1; n < parts.size(); ++n) {
            numbers.push_back(std::uint32_t(contour_.triangleCount()));
            contour_.triangles.insert(contour_.triangles.end(), parts[n].begin(), parts[n].end());
        }
        return numbers;
    }

    const std::vector<DividedEdge>& edges_;
    Contour& contour_;
    std::uint32_t first_;             ///< number of the first edge's middle
    std::vector<std::uint8_t> ends_;  ///< of each point, whether it ends a divided edge
};

}  // namespace

void divideAtRims(const Volume<std::int16_t>& field, Contour& contour)
{
    const SmoothField smooth(field);
    std::vector<std::uint32_t> triangles(contour.triangleCount());
    for (std::uint32_t n = 0; n < triangles.size(); ++n)
        triangles[n] = n;
    for (int round = 0; round < kDivisions && !triangles.empty(); ++round) {
        const std::vector<DividedEdge> edges = edgesOff(smooth, contour, triangles);
        Division division(edges, contour);
        std::vector<std::uint32_t> parts;
        for (const std::uint32_t triangle : triangles) {
            const auto made = division.divide(triangle);
            parts.insert(parts.end(), made.begin(), made.end());
        }
        triangles.swap(parts);  // an edge that was not divided would not be now
    }
}

}  // namespace vicon::steps
