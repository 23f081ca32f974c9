#include "vicon/viewer/model/sight_lines.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "patch_blocks.h"
#include "sight_field.h"

namespace vicon::viewer {
namespace {

/// Squares along the picture's height: those that bundles start with, those that tell patches, those into which a
/// bundle is split that runs into a thin wall, and those far away. Chosen on ctc-prone and the default phantom.
constexpr float kFirst = 12, kTelling = 24, kFinest = 96, kFinestFar = 192;
/// Voxels from a bundle's middle to its side: a wider one is split before it tells patches, and one that runs into a
/// wall is split into the finest squares of far away. A wide bundle meets much that lies behind a fold's edge.
constexpr float kWideTelling = 3, kWideInWall = 1.5;
/// Bundles are wider than their squares by this part of a voxel, and by this part of the finest square: what the
/// graphics driver's arithmetic and that of bundles, both of single precision, may be off.
constexpr float kSlackVoxels = 0.02, kSlackSquares = 0.05;
constexpr float kLeastStep = 1;  // voxel: no step in the wall crosses two planes of voxels
constexpr float kOpenSteps = 2;  // at once, where the lumen is open: there no end is looked for
/// Steps that a bundle goes on in the wall before it is split.
constexpr int kMostInWall = 8;
constexpr float kSightReach_mm = 2000;  // as far as pictures are drawn

/// A square of the plane at depth 1 from the eye.
struct Square {
    float x = 0, y = 0;  ///< its middle, to the right and up
    float half = 0;
    float from = 0;  ///< the depth up to which nothing but lumen has been found
};

/// Along each axis of the grid how far the lines through a square's four corners go for each step of depth, and how
/// deep they go for each voxel.
struct Corners {
    std::array<Float4, 3> way, depth;
};

Float4 inVoxels(const Grid& grid, Vector3 v)
{
    return Float4{float(dot(v, grid.axis[0]) / grid.spacing_mm[0]), float(dot(v, grid.axis[1]) / grid.spacing_mm[1]),
                  float(dot(v, grid.axis[2]) / grid.spacing_mm[2]), 0};
}

Float4 inVoxels(const Grid& grid, Point3 p)
{
    const ContinuousIndex3 at = grid.continuousIndexAt(p);
    return Float4{float(at.i), float(at.j), float(at.k), 0};
}

Float4 sizeOf(Float4 a)
{
    return mostOf(a, -a);
}

/// The bundles of one picture.
class Bundles {
public:
    Bundles(const SightField& field, const PatchBlocks& blocks, const Pose& pose, const Lens& lens,
            PatchBlocks::Cubes& cubes)
        : field_(field),
          blocks_(blocks),
          cubes_(cubes),
          eye_(inVoxels(field.grid(), pose.eye_mm)),
          forward_(inVoxels(field.grid(), pose.forward)),
          right_(inVoxels(field.grid(), pose.right())),
          up_(inVoxels(field.grid(), pose.up)),
          wide_(sizeOf(right_) + sizeOf(up_)),
          widest_(mostIn(wide_)),
          top_(float(std::tan(radians(lens.view_angle_deg) / 2)))
    {
    }

    float top() const { return top_; }

    void follow(const Square& square) const
    {
        const Float4 way = wayThrough(square);
        const float speed = mostIn(sizeOf(way));
        const float half = square.half + kSlackSquares * top_ / kFinest, spread = half * widest_;
        const Corners corners = cornersOf(square, half);
        const bool telling = atMost(square, kTelling), fine = atMost(square, kFinest);
        const bool finest_far = atMost(square, kFinestFar);
        const float step = kLeastStep / speed;
        std::array<float, kMostInWall + 1> in_wall{};  // depths of steps that are not told yet
        int waiting = 0;
        for (float depth = square.from; depth < kSightReach_mm;) {
            const SightField::Clear clear = field_.at(along(way, depth));
            const bool open = clear.kind == SightField::Kind::open;
            const float free = clear.voxels - depth * spread - kSlackVoxels;
            float end = clear.kind == SightField::Kind::solid && free > 0 ? depth : 0;
            const float leap = open ? free / (speed + spread) : 0;
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
                end = endOf(corners, way, depth, depth + step);
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
    bool atMost(const Square& square, float along_height) const { return square.half <= top_ / along_height * 1.001F; }

    Float4 wayThrough(const Square& square) const { return forward_ + square.x * right_ + square.y * up_; }

    Corners cornersOf(const Square& square, float half) const
    {
        const Float4 x = square.x + Float4{-half, half, -half, half}, y = square.y + Float4{-half, -half, half, half};
        Corners corners;
        for (std::size_t d = 0; d < 3; ++d) {
            corners.way[d] = forward_[d] + x * right_[d] + y * up_[d];
            corners.depth[d] = 1 / corners.way[d];
        }
        return corners;
    }

    Float4 along(Float4 way, float depth) const { return eye_ + depth * way; }

    // Where the whole bundle crosses a plane of voxels between two depths of its middle, and all voxels around the
    // crossing are outside: the greatest depth of a crossing; else 0. This finds walls that are too thin for a solid
    // cube.
    float endOf(const Corners& corners, Float4 way, float depth, float next) const
    {
        const Float4 a = along(way, depth), b = along(way, next);
        const Float4 plane = way > 0 ? -toFloat4(floorOf(-a)) : toFloat4(floorOf(a));
        const Int4 crossed = ((plane - a) * (b - plane) >= 0) & (a != b);
        for (int axis = 0; axis < 3; ++axis)
            if (crossed[axis])
                if (const float last = endAt(corners, std::size_t(axis), plane[axis], next + 3 * (next - depth));
                    last > 0)
                    return last;
        return 0;
    }

    float endAt(const Corners& corners, std::size_t axis, float plane, float most) const
    {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        const Float4 depth = (plane - eye_[axis]) * corners.depth[axis];
        if (!allOf((depth > 0) & (depth < most)))
            return 0;
        const Float4 along_u = eye_[u] + depth * corners.way[u], along_v = eye_[v] + depth * corners.way[v];
        // The next voxels below the least of them; those above the greatest, with the signs turned round.
        const Int4 around =
            floorOf(Float4{leastIn(along_u), leastIn(along_v), -mostIn(along_u), -mostIn(along_v)} - kSlackVoxels);
        const bool blocked = field_.outside(axis, int(plane), {around[0], around[1]}, {-around[2], -around[3]});
        return blocked ? mostIn(depth) : 0;
    }

    void split(const Square& square, float from) const
    {
        const float h = square.half / 2;
        for (int n = 0; n < 4; ++n)
            follow({square.x + (n & 1 ? h : -h), square.y + (n & 2 ? h : -h), h, from});
    }

    void tell(Float4 way, float from, float to, float half) const
    {
        const Float4 a = along(way, from), b = along(way, to), wide = to * half * wide_ + kSlackVoxels;
        const Int4 low = floorOf(leastOf(a, b) - wide) + 1, high = floorOf(mostOf(a, b) + wide) + 1;
        blocks_.add(cubes_, {low[0], low[1], low[2]}, {high[0], high[1], high[2]});
    }

    const SightField& field_;
    const PatchBlocks& blocks_;
    PatchBlocks::Cubes& cubes_;          ///< what bundles have met
    Float4 eye_, forward_, right_, up_;  ///< in voxels
    Float4 wide_;   ///< along each axis, how far a square of half edge 1 reaches from its middle, at depth 1
    float widest_;  ///< the most of these
    float top_;     ///< of the picture, at depth 1
};

}  // namespace

struct SightLines::Parts {
    SightField field;
    PatchBlocks blocks;
};

SightLines::SightLines(const InsideView& inside, const DrawnSurface& surface, const Progress* wanted)
    : parts_(std::make_unique<Parts>(Parts{SightField(inside, wanted), PatchBlocks(inside.grid, surface)}))
{
}

SightLines::~SightLines() = default;
SightLines::SightLines(SightLines&&) noexcept = default;
SightLines& SightLines::operator=(SightLines&&) noexcept = default;

bool SightLines::holdsAt(Point3 eye_mm, double near_mm) const
{
    const Grid& grid = parts_->field.grid();
    const SightField::Clear clear = parts_->field.at(inVoxels(grid, eye_mm));
    return clear.kind == SightField::Kind::open &&
           (clear.voxels - kSlackVoxels) * std::min({grid.spacing_mm[0], grid.spacing_mm[1], grid.spacing_mm[2]}) >
               near_mm;
}

std::vector<std::uint8_t> SightLines::visibleFrom(const Pose& pose, const Lens& lens) const
{
    PatchBlocks::Cubes cubes = parts_->blocks.none();
    const Bundles bundles(parts_->field, parts_->blocks, pose, lens, cubes);
    const float half = bundles.top() / kFirst;
    const double wide = lens.height > 0 ? double(kFirst) * lens.width / lens.height : double(kFirst);
    const int rows = int(kFirst), columns = std::max(1, int(std::ceil(wide - 1e-9)));
    tbb::parallel_for(0, rows * columns, [&](int n) {
        const int column = n % columns, row = n / columns;
        bundles.follow({half * float(2 * column + 1 - columns), half * float(2 * row + 1 - rows), half, 0});
    });
    return parts_->blocks.patchesIn(cubes);
}

}  // namespace vicon::viewer
