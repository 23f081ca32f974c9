#include "vicon/cases/polyp_size.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "polyp_outline.h"
#include "surface_around.h"
#include "vicon/cases/step_results.h"
#include "vicon/core/scanner_blur.h"
#include "vicon/scan_files/description_file.h"

namespace vicon {
namespace {
/// A polyp that does not come out from the nearest of the surface around the point comes out from none. Chosen on the
/// clicks into 108 synthetic polyps.
constexpr std::size_t kMostTries = 6;
}  // namespace

PolypOutline outlinePolyp(const CellSurface& surface, Point3 at, double blur_mm, const Progress* wanted)
{
    PolypOutline nearest{std::nullopt, "no wall lies near enough"};
    const std::vector<Point3> around = surfaceAround(surface, at, kPolypReach_mm, kPolypCatch_mm);
    for (std::size_t n = 0; n < std::min(around.size(), kMostTries); ++n) {
        PolypOutline outline = outlineFrom(surface, around[n], at, blur_mm, wanted);
        if (outline.size)
            return outline;
        if (n == 0)
            nearest = std::move(outline);
    }
    return nearest;
}

double blurOfScan_mm(const std::filesystem::path& scan_folder)
{
    const StepResults results = resultsOf(scan_files::readDescription(scan_folder).steps);
    return results.tissue ? results.tissue->blur_mm.value_or(kUsualBlur_mm) : kUsualBlur_mm;
}

MarkerSize sizeOf(const PolypSize& polyp)
{
    return {.straight_mm = polyp.diameter_mm, .from_mm = polyp.from_mm, .to_mm = polyp.to_mm, .polyp = polyp};
}

}  // namespace vicon
