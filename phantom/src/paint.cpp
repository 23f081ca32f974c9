#include "paint.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "densities.h"
#include "lumen_content.h"
#include "trunk_painter.h"

namespace vicon::phantom {
namespace {

constexpr double kFat_hu = -98;
constexpr double kFatRim_mm = 2.5;  // of fat around the colon's wall

struct Box {
    Index3 from, to;  // inclusive
};

/// The voxels that a solid may touch.
Box boxOf(const Grid& grid, const Solid& solid)
{
    const ContinuousIndex3 a = grid.continuousIndexAt(solid.a), b = grid.continuousIndexAt(solid.b);
    const double low[3] = {std::min(a.i, b.i), std::min(a.j, b.j), std::min(a.k, b.k)};
    const double high[3] = {std::max(a.i, b.i), std::max(a.j, b.j), std::max(a.k, b.k)};
    int from[3], to[3];
    for (std::size_t n = 0; n < 3; ++n) {
        const Vector3 axis = grid.axis[n], r = solid.radii_mm;
        const double reach = length(Vector3{axis.x * r.x, axis.y * r.y, axis.z * r.z}) / grid.spacing_mm[n] + 1.5;
        from[n] = std::max(0, int(std::floor(low[n] - reach)));
        to[n] = std::min(grid.size[n] - 1, int(std::ceil(high[n] + reach)));
    }
    return {{from[0], from[1], from[2]}, {to[0], to[1], to[2]}};
}

struct BoxedSolid {
    const Solid* solid;
    Box box;
};

std::vector<BoxedSolid> boxed(const Grid& grid, const std::vector<Solid>& solids)
{
    std::vector<BoxedSolid> out;
    for (const Solid& solid : solids)
        out.push_back({&solid, boxOf(grid, solid)});
    return out;
}

/// Calls `visit(i, j, solid, share)` for the voxels of slice k, `share` of which the solid fills.
void eachVoxelOf(const Grid& grid, const BoxedSolid& item, int k, double voxel_mm, auto&& visit)
{
    const auto& [from, to] = item.box;
    if (k < from.k || k > to.k)
        return;
    const Vector3 step = grid.axis[0] * grid.spacing_mm[0];
    for (int j = from.j; j <= to.j; ++j) {
        Point3 p = grid.pointAt(Index3{from.i, j, k});
        for (int i = from.i; i <= to.i; ++i, p += step) {
            const double share = 0.5 - distanceTo(*item.solid, p) / voxel_mm;
            if (share > 0)
                visit(i, j, p, std::min(share, 1.0));
        }
    }
}

class Painter {
public:
    Painter(const Grid& grid, const Scene& scene, const LumenField& field, const PhantomTruth& truth)
        : grid_(grid),
          scene_(scene),
          field_(field),
          content_(scene, truth),
          trunk_(scene),
          up_(-scene.down),
          organs_(boxed(grid, scene.organs)),
          bones_(boxed(grid, scene.bones)),
          ileum_wall_(boxed(grid, scene.ileum_wall)),
          ileum_lumen_(boxed(grid, scene.ileum_lumen)),
          tube_(boxed(grid, scene.tube)),
          voxel_mm_(std::cbrt(grid.voxelVolume_mm3())),
          hu_(grid)
    {
    }

    void slice(int k)
    {
        std::int16_t* out = &hu_.voxels[grid_.offset({0, 0, k})];
        trunk_.body(grid_, k, out);
        solids(organs_, k, out);
        trunk_.lungs(grid_, k, out);
        solids(bones_, k, out);
        solids(ileum_wall_, k, out);
        colon(k, out);
        solids(ileum_lumen_, k, out);
        solids(tube_, k, out);
        trunk_.beyondCircle(grid_, out);
    }
    HuVolume take() { return std::move(hu_); }

private:
    void solids(const std::vector<BoxedSolid>& items, int k, std::int16_t* out) const
    {
        for (const BoxedSolid& item : items) {
            const Solid& solid = *item.solid;
            eachVoxelOf(grid_, item, k, voxel_mm_, [&](int i, int j, Point3 p, double share) {
                double hu = solid.density_hu;
                if (solid.has_level) {
                    const double gas =
                        std::clamp(0.5 + (dot(p - Point3{}, up_) - solid.level_mm) / voxel_mm_, 0.0, 1.0);
                    hu += gas * (kGas_hu - hu);
                }
                std::int16_t& v = out[std::size_t(j) * std::size_t(grid_.size[0]) + std::size_t(i)];
                v = std::int16_t(std::lround(v + share * (hu - v)));
            });
        }
    }

    void colon(int k, std::int16_t* out) const
    {
        if (k < field_.low.k || k >= field_.low.k + field_.size[2])
            return;
        for (int j = field_.low.j; j < field_.low.j + field_.size[1]; ++j)
            for (int i = field_.low.i; i < field_.low.i + field_.size[0]; ++i) {
                const std::size_t at = field_.offset({i, j, k});
                if (field_.outside[at] == LumenField::kFar)
                    continue;
                std::int16_t& v = out[std::size_t(j) * std::size_t(grid_.size[0]) + std::size_t(i)];
                const double rim = std::clamp((kFatRim_mm - mm(field_.outside[at])) / 1.0 + 0.5, 0.0, 1.0);
                const double wall = std::clamp(0.5 - mm(field_.outside[at]) / voxel_mm_, 0.0, 1.0);
                const double lumen = std::clamp(0.5 - mm(field_.lumen[at]) / voxel_mm_, 0.0, 1.0);
                double hu = v + rim * (kFat_hu - v);
                hu += wall * (scene_.wall_hu - hu);
                if (lumen > 0)
                    hu +=
                        lumen * (content_.density_hu(grid_.pointAt(Index3{i, j, k}), field_.pool[at], voxel_mm_) - hu);
                v = std::int16_t(std::lround(hu));
            }
    }
    static double mm(std::int8_t stored) { return (stored + 0.5) * LumenField::kUnit_mm; }

    const Grid& grid_;
    const Scene& scene_;
    const LumenField& field_;
    LumenContent content_;
    TrunkPainter trunk_;
    Vector3 up_;
    std::vector<BoxedSolid> organs_, bones_, ileum_wall_, ileum_lumen_, tube_;
    double voxel_mm_;
    HuVolume hu_;
};

}  // namespace

HuVolume paintScene(const Grid& grid, const Scene& scene, const LumenField& field, const PhantomTruth& truth,
                    Progress& progress)
{
    Painter painter(grid, scene, field, truth);
    tbb::parallel_for(0, grid.size[2], [&](int k) {
        progress.check();
        painter.slice(k);
    });
    return painter.take();
}

InsideVolume labelLumen(const Grid& grid, const Scene& scene, const LumenField& field, const PhantomTruth& truth)
{
    InsideVolume inside(grid);
    const LumenContent content(scene, truth);
    const auto tube = boxed(grid, scene.tube);
    tbb::parallel_for(field.low.k, field.low.k + field.size[2], [&](int k) {
        for (int j = field.low.j; j < field.low.j + field.size[1]; ++j)
            for (int i = field.low.i; i < field.low.i + field.size[0]; ++i) {
                const std::size_t at = field.offset({i, j, k});
                if (field.lumen[at] >= 0)
                    continue;
                inside.at({i, j, k}) = content.label(grid.pointAt(Index3{i, j, k}), field.pool[at]);
            }
        for (const BoxedSolid& item : tube)
            eachVoxelOf(grid, item, k, 1e-6, [&](int i, int j, Point3, double) { inside.at({i, j, k}) = kOutside; });
    });
    return inside;
}

}  // namespace vicon::phantom
