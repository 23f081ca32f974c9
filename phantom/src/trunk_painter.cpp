#include "trunk_painter.h"

#include <algorithm>
#include <cmath>

#include "vicon/core/volume.h"

namespace vicon::phantom {
namespace {

constexpr double kAir_hu = -1000, kFat_hu = -105, kSkin_hu = 10, kMuscle_hu = 55, kBellyFat_hu = -98, kLung_hu = -850;
constexpr double kSkin_mm = 2, kMuscle_mm = 13;
constexpr double kTableShell_mm = 2, kTable_mm = 26, kTableHalfWidth_mm = 200, kTableCurve_mm = 500;

double share(double inside_mm)
{
    return std::clamp(0.5 + inside_mm, 0.0, 1.0);
}

}  // namespace

PowerTable::PowerTable(double exponent)
{
    for (int n = 0; n < kEntries + 2; ++n)
        values_[std::size_t(n)] = float(std::pow(n * kLargest / kEntries, exponent));
}

double PowerTable::operator()(double u) const
{
    const double at = std::min(std::abs(u) * (kEntries / kLargest), double(kEntries));
    const auto n = std::size_t(at);
    return std::lerp(double(values_[n]), double(values_[n + 1]), at - double(n));
}

TrunkPainter::TrunkPainter(const Scene& scene)
    : scene_(scene), skin_(scene.trunk.skin(0).exponent), cavity_(scene.trunk.cavity(0).exponent)
{
}

double TrunkPainter::tableDensity(Point3 p) const
{
    // A curved shell over foam, as on the couch of a scanner.
    const Vector3 aside = cross(scene_.down, Vector3{0, 0, 1});
    const double across = dot(p - Point3{}, aside);
    const double depth = dot(p - Point3{}, scene_.down) - scene_.table_mm + across * across / kTableCurve_mm / 2;
    const double thick = kTable_mm * (1 - std::pow(across / kTableHalfWidth_mm, 2));
    if (thick <= 0 || depth < -1 || depth > thick + 1)
        return kAir_hu;
    const double in_table = std::min(share(depth), share(thick - depth));
    const double in_foam = std::min(share(depth - kTableShell_mm), share(thick - kTableShell_mm - depth));
    return kAir_hu + in_table * (60 - kAir_hu) + in_foam * (-930 - 60);
}

void TrunkPainter::body(const Grid& grid, int k, std::int16_t* out) const
{
    const Vector3 step = grid.axis[0] * grid.spacing_mm[0];
    for (int j = 0; j < grid.size[1]; ++j) {
        Point3 p = grid.pointAt(Index3{0, j, k});
        const Oval skin = scene_.trunk.skin(p.z), room = scene_.trunk.cavity(p.z);
        for (int i = 0; i < grid.size[0]; ++i, p += step) {
            const double f = skin_(p.x / skin.half_x_mm) + skin_((p.y - skin.centre_y_mm) / skin.half_y_mm);
            const double depth_mm = (1 - f) * skin.half_y_mm / skin.exponent;
            if (depth_mm < -2) {
                *out++ = std::int16_t(std::lround(tableDensity(p)));
                continue;
            }
            const double g = cavity_(p.x / room.half_x_mm) + cavity_((p.y - room.centre_y_mm) / room.half_y_mm);
            const double room_mm = (1 - g) * room.half_y_mm / room.exponent;
            double hu = kSkin_hu + share(depth_mm - kSkin_mm) * (kFat_hu - kSkin_hu);
            hu += share(room_mm + kMuscle_mm) * share(depth_mm - kSkin_mm - 3) * (kMuscle_hu - hu);
            hu += share(room_mm) * (kBellyFat_hu - hu);
            *out++ = std::int16_t(std::lround(kAir_hu + share(depth_mm) * (hu - kAir_hu)));
        }
    }
}

void TrunkPainter::lungs(const Grid& grid, int k, std::int16_t* out) const
{
    const Vector3 step = grid.axis[0] * grid.spacing_mm[0];
    for (int j = 0; j < grid.size[1]; ++j) {
        Point3 p = grid.pointAt(Index3{0, j, k});
        const Oval room = scene_.trunk.cavity(p.z);
        for (int i = 0; i < grid.size[0]; ++i, p += step, ++out) {
            if (p.z < 335)
                continue;
            const double g = cavity_(p.x / room.half_x_mm) + cavity_((p.y - room.centre_y_mm) / room.half_y_mm);
            const double room_mm = (1 - g) * room.half_y_mm / room.exponent;
            if (room_mm < 0)
                continue;
            const double middle = std::hypot((p.x - 4) / 34, (p.y - 10) / 125) - 1;
            const double s =
                share(room_mm - 1) * share(middle * 34) * share((p.z - scene_.trunk.diaphragm(p.x, p.y)) * 0.6);
            const double hu = kLung_hu + 0.35 * dot(p - Point3{}, scene_.down);  // denser below
            *out = std::int16_t(std::lround(*out + s * (hu - *out)));
        }
    }
}

void TrunkPainter::beyondCircle(const Grid& grid, std::int16_t* out) const
{
    const double radius_mm = std::min(grid.size[0] * grid.spacing_mm[0], grid.size[1] * grid.spacing_mm[1]) / 2;
    for (int j = 0; j < grid.size[1]; ++j)
        for (int i = 0; i < grid.size[0]; ++i, ++out)
            if (std::hypot((i - (grid.size[0] - 1) / 2.0) * grid.spacing_mm[0],
                           (j - (grid.size[1] - 1) / 2.0) * grid.spacing_mm[1]) > radius_mm)
                *out = kPaddingHu;
}

}  // namespace vicon::phantom
