#include "vicon/cases/polyp_size.h"

#include <optional>
#include <utility>

#include "polyp_outline.h"
#include "surface_around.h"
#include "vicon/cases/step_results.h"
#include "vicon/scan_files/description_file.h"

namespace vicon {
namespace {
constexpr double kSamePatch_mm = 5;  // so much of a patch may be missing on the other side: a polyp's reach is far less
}

PolypOutline outlinePolyp(const CellSurface& surface, const InsideView& lumen, Point3 at, const BlurAndNoise& scan,
                          const Progress* wanted)
{
    PolypOutline nearest{{}, {}, "no wall lies near enough"};
    std::optional<SurfacePatch> patch;
    for (const Point3 from : surfaceAround(surface, at, kPolypReach_mm, kPolypCatch_mm)) {
        const bool first = !patch;
        if (first || distance(patch->nearest_mm(), from) > kSamePatch_mm || !patch->holds(from))
            patch.emplace(surface, from, kPolypPatch_mm, kPolypCatch_mm);
        TriedOutline tried = outlineFrom(*patch, lumen, from, at, scan, wanted);
        if (tried.decided)
            return tried.outline;
        if (first)
            nearest = std::move(tried.outline);
    }
    return nearest;
}

BlurAndNoise blurAndNoiseOf(const std::filesystem::path& scan_folder)
{
    const StepResults results = resultsOf(scan_files::readDescription(scan_folder).steps);
    BlurAndNoise scan;
    if (results.tissue)
        scan.blur_mm = results.tissue->blur_mm.value_or(scan.blur_mm);
    if (results.segment)
        scan.noise_hu = results.segment->usualNoise_hu().value_or(scan.noise_hu);
    return scan;
}

MarkerSize sizeOf(const PolypOutline& outline)
{
    const PolypSize& polyp = outline.size.value();
    return {.straight_mm = polyp.diameter_mm,
            .from_mm = polyp.from_mm,
            .to_mm = polyp.to_mm,
            .plane = outline.plane,
            .polyp = polyp};
}

}  // namespace vicon
