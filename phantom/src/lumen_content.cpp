#include "lumen_content.h"

#include <algorithm>

#include "densities.h"
#include "lumen_field.h"
#include "stool.h"

namespace vicon::phantom {
namespace {

/// Adds what takes the place of the content so far.
void cover(double& hu, double by_hu, double inside_mm, double voxel_mm)
{
    hu += std::clamp(0.5 + inside_mm / voxel_mm, 0.0, 1.0) * (by_hu - hu);
}

}  // namespace

double LumenContent::density_hu(Point3 p, std::uint8_t pool, double voxel_mm) const
{
    double hu = kGas_hu;
    if (pool != LumenField::kNoPool) {
        const FluidPool& fluid = truth_.pools[pool];
        cover(hu, fluid.density_hu, fluid.level_mm - dot(p - Point3{}, up_), voxel_mm);
    }
    if (pool != LumenField::kNoPool)
        for (const GasBubble& bubble : truth_.bubbles)
            if (const double off_mm = distance(p, bubble.position_mm) - bubble.diameter_mm / 2; off_mm < voxel_mm)
                cover(hu, kGas_hu, -off_mm, voxel_mm);
    for (const StoolLump& lump : truth_.stool) {
        if (distance(p, lump.position_mm) > lump.diameter_mm / 2 + voxel_mm)
            continue;
        const double inside_mm = -distanceTo(lump, p);
        cover(hu, lump.density_hu, inside_mm, voxel_mm);
        if (lump.airy)
            cover(hu, kGas_hu, std::min(inside_mm, -distanceToBubble(lump, p)), voxel_mm);
    }
    for (const TaggingFilm& film : truth_.films) {
        const Polyp& polyp = truth_.polyps[film.polyp];
        const double off_mm = distance(p, polyp.position_mm) - polyp.diameter_mm / 2;
        cover(hu, film.density_hu, film.thickness_mm - off_mm, voxel_mm);
    }
    return hu;
}

std::uint8_t LumenContent::label(Point3 p, std::uint8_t pool) const
{
    return density_hu(p, pool, 1e-6) > (kGas_hu + kWall_hu) / 2 ? kFluid : kGas;
}

}  // namespace vicon::phantom
