#include "vicon/viewer/model/sight_lines.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "patch_blocks.h"
#include "sight_field.h"

namespace vicon::viewer {
namespace {

using Voxels = std::array<double, 3>;  // a place or a step, counted in voxels along the grid's axes

/// Squares along the picture's height: those that bundles start with, those that tell patches, those into which a
/// bundle is split that runs into a thin wall, and those far away. Chosen on ctc-prone and the default phantom.
constexpr double kFirst = 12, kTelling = 24, kFinest = 96, kFinestFar = 192;
/// Voxels from a bundle's middle to its side: a wider one is split before it tells patches, and one that runs into a
/// wall is split into the finest squares of far away. A wide bundle meets much that lies behind a fold's edge.
constexpr double kWideTelling = 3, kWideInWall = 1.5;
/// Bundles are wider than their squares by this part of a voxel, and by this part of the finest square: what the
/// graphics driver's arithmetic may be off.
constexpr double kSlackVoxels = 0.02, kSlackSquares = 0.05;
constexpr double kLeastStep = 1;  // voxel: no step in the wall crosses two planes of voxels
constexpr double kOpenSteps = 2;  // at once, where the lumen is open: there no end is looked for
/// Steps that a bundle goes on in the wall before it is split.
constexpr int kMostInWall = 8;
constexpr double kReach_mm = 2000;  // as far as pictures are drawn

/// A square of the plane at depth 1 from the eye.
struct Square {
    double x = 0, y = 0;  ///< its middle, to the right and up
    double half = 0;
    double from = 0;  ///< the depth up to which nothing but lumen has been found
};

Voxels inVoxels(const Grid& grid, Vector3 v)
{
    return {dot(v, grid.axis[0]) / grid.spacing_mm[0], dot(v, grid.axis[1]) / grid.spacing_mm[1],
            dot(v, grid.axis[2]) / grid.spacing_mm[2]};
}

/// The bundles of one picture.
class Bundles {
public:
    Bundles(const SightField& field, const PatchBlocks& blocks, const Pose& pose, const Lens& lens,
            PatchBlocks::Cubes& cubes)
        : field_(field), blocks_(blocks), cubes_(cubes)
    {
        const ContinuousIndex3 eye = field.grid().continuousIndexAt(pose.eye_mm);
        eye_ = {eye.i, eye.j, eye.k};
        forward_ = inVoxels(field.grid(), pose.forward);
        right_ = inVoxels(field.grid(), pose.right());
        up_ = inVoxels(field.grid(), pose.up);
        for (std::size_t d = 0; d < 3; ++d)
            wide_[d] = std::abs(right_[d]) + std::abs(up_[d]);
        widest_ = *std::max_element(wide_.begin(), wide_.end());
        top_ = std::tan(radians(lens.view_angle_deg) / 2);
    }

    double top() const { return top_; }

    void follow(const Square& square) const
    {
        const Voxels way = wayThrough(square);
        const double speed = std::max({std::abs(way[0]), std::abs(way[1]), std::abs(way[2])});
        const double half = square.half + kSlackSquares * top_ / kFinest, spread = half * widest_;
        const bool telling = atMost(square, kTelling), fine = atMost(square, kFinest);
        const bool finest_far = atMost(square, kFinestFar);
        const double step = kLeastStep / speed;
        std::array<double, kMostInWall + 1> in_wall{};  // depths of steps that are not told yet
        int waiting = 0;
        for (double depth = square.from; depth < kReach_mm;) {
            const Voxels p = along(way, depth);
            const SightField::Clear clear = field_.at(p);
            const bool open = clear.kind == SightField::Kind::open;
            const double free = clear.voxels - depth * spread - kSlackVoxels;
            double end = clear.kind == SightField::Kind::solid && free > 0 ? depth : 0;
            const double leap = open ? free / (speed + spread) : 0;
            if (waiting == 0 && leap >= step) {
                depth += leap;
                continue;
            }
            const bool finest = finest_far || (fine && depth * spread <= kWideInWall);
            if (!telling || (!finest && depth * spread > kWideTelling)) {
                split(square, waiting > 0 ? in_wall[0] : depth);
                return;
            }
            if (end == 0 && !open)
                end = endOf(square, way, depth, depth + step);
            if (end > 0) {
                for (int n = 0; n < waiting; ++n)
                    tell(way, in_wall[std::size_t(n)], in_wall[std::size_t(n)] + step, half);
                if (end > depth)
                    tell(way, depth, end, half);
                return;
            }
            if (!finest && (waiting == kMostInWall || (open && waiting > 0))) {
                split(square, in_wall[0]);
                return;
            }
            if (open && waiting == 0) {
                tell(way, depth, depth + kOpenSteps * step, half);
                depth += kOpenSteps * step;
                continue;
            }
            if (finest)
                tell(way, depth, depth + step, half);
            else
                in_wall[std::size_t(waiting++)] = depth;
            depth += step;
        }
    }

private:
    bool atMost(const Square& square, double along_height) const { return square.half <= top_ / along_height * 1.001; }

    Voxels wayThrough(const Square& square) const
    {
        Voxels way{};
        for (std::size_t d = 0; d < 3; ++d)
            way[d] = forward_[d] + square.x * right_[d] + square.y * up_[d];
        return way;
    }

    Voxels along(const Voxels& way, double depth) const
    {
        return {eye_[0] + depth * way[0], eye_[1] + depth * way[1], eye_[2] + depth * way[2]};
    }

    // Where the whole bundle crosses a plane of voxels between two depths of its middle, and all voxels around the
    // crossing are outside: the greatest depth of a crossing; else 0. This finds walls that are too thin for a solid
    // cube.
    double endOf(const Square& square, const Voxels& way, double depth, double next) const
    {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double a = eye_[axis] + depth * way[axis], b = eye_[axis] + next * way[axis];
            const double plane = way[axis] > 0 ? ceilOf(a) : floorOf(a);
            if ((plane - a) * (b - plane) < 0 || a == b)
                continue;
            if (const double last = endAt(square, axis, plane, next + 3 * (next - depth)); last > 0)
                return last;
        }
        return 0;
    }

    double endAt(const Square& square, std::size_t axis, double plane, double most) const
    {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double half = square.half + kSlackSquares * top_ / kFinest;
        std::array<double, 2> low{1e300, 1e300}, high{-1e300, -1e300};
        double last = 0;
        for (int n = 0; n < 4; ++n) {
            const Voxels way = wayThrough({square.x + (n & 1 ? half : -half), square.y + (n & 2 ? half : -half), 0, 0});
            const double depth = (plane - eye_[axis]) / way[axis];
            if (!(depth > 0 && depth < most))
                return 0;
            last = std::max(last, depth);
            const Voxels p = along(way, depth);
            low = {std::min(low[0], p[u]), std::min(low[1], p[v])};
            high = {std::max(high[0], p[u]), std::max(high[1], p[v])};
        }
        const auto below = [](double x) { return floorOf(x - kSlackVoxels); };
        const auto above = [](double x) { return ceilOf(x + kSlackVoxels); };
        const bool blocked =
            field_.outside(axis, int(plane), {below(low[0]), below(low[1])}, {above(high[0]), above(high[1])});
        return blocked ? last : 0;
    }

    void split(const Square& square, double from) const
    {
        const double h = square.half / 2;
        for (int n = 0; n < 4; ++n)
            follow({square.x + (n & 1 ? h : -h), square.y + (n & 2 ? h : -h), h, from});
    }

    void tell(const Voxels& way, double from, double to, double half) const
    {
        const Voxels a = along(way, from), b = along(way, to);
        std::array<int, 3> low{}, high{};
        for (std::size_t d = 0; d < 3; ++d) {
            const double wide = to * half * wide_[d] + kSlackVoxels;
            low[d] = floorOf(std::min(a[d], b[d]) - wide) + 1;
            high[d] = floorOf(std::max(a[d], b[d]) + wide) + 1;
        }
        blocks_.add(cubes_, low, high);
    }

    const SightField& field_;
    const PatchBlocks& blocks_;
    PatchBlocks::Cubes& cubes_;  ///< what bundles have met
    Voxels eye_{}, forward_{}, right_{}, up_{};
    Voxels wide_{};      ///< along each axis, how far a square of half edge 1 reaches from its middle, at depth 1
    double widest_ = 0;  ///< the most of these
    double top_ = 0;     ///< of the picture, at depth 1
};

}  // namespace

struct SightLines::Parts {
    SightField field;
    PatchBlocks blocks;
};

SightLines::SightLines(const InsideView& inside, const DrawnSurface& surface)
    : parts_(std::make_unique<Parts>(Parts{SightField(inside), PatchBlocks(inside.grid, surface)}))
{
}

SightLines::~SightLines() = default;
SightLines::SightLines(SightLines&&) noexcept = default;
SightLines& SightLines::operator=(SightLines&&) noexcept = default;

bool SightLines::holdsAt(Point3 eye_mm, double near_mm) const
{
    const Grid& grid = parts_->field.grid();
    const ContinuousIndex3 eye = grid.continuousIndexAt(eye_mm);
    const SightField::Clear clear = parts_->field.at({eye.i, eye.j, eye.k});
    return clear.kind == SightField::Kind::open &&
           clear.voxels * std::min({grid.spacing_mm[0], grid.spacing_mm[1], grid.spacing_mm[2]}) > near_mm;
}

std::vector<std::uint8_t> SightLines::seenFrom(const Pose& pose, const Lens& lens) const
{
    PatchBlocks::Cubes cubes = parts_->blocks.none();
    const Bundles bundles(parts_->field, parts_->blocks, pose, lens, cubes);
    const double half = bundles.top() / kFirst;
    const double side = lens.height > 0 ? bundles.top() * lens.width / lens.height : bundles.top();
    const int rows = int(kFirst), columns = std::max(1, int(std::ceil(side / half - 1e-9)));
    tbb::parallel_for(0, rows * columns, [&](int n) {
        const int column = n % columns, row = n / columns;
        bundles.follow({half * (2 * column + 1 - columns), half * (2 * row + 1 - rows), half, 0});
    });
    return parts_->blocks.patchesIn(cubes);
}

}  // namespace vicon::viewer
