#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <vector>

#include "grid/neighbours.h"
#include "segment/signal/classes.h"
#include "vicon/steps/lumen_contrast.h"

namespace vicon::steps {
namespace {

/// How far from the lumen its wall is the brightest there is. Chosen on the phantom of seed 3, dark, whose walls are
/// 2 to 3 mm thick at voxels of 1.5 mm.
constexpr int kWallReach_voxels = 3;
constexpr std::int16_t kLeastBeyond = kUsualTissue_hu;

/// The lumen as a part of the scan that begins at `low`.
struct LumenInScan {
    const InsideVolume& lumen;
    Index3 low;

    bool isLumen(Index3 of_scan) const
    {
        return lumen.valueOr({of_scan.i - low.i, of_scan.j - low.j, of_scan.k - low.k}, kOutside) != kOutside;
    }
};

template <class Use>
void forEachOfLumen(const LumenInScan& place, Use use)
{
    for (std::size_t n = 0; n < place.lumen.voxels.size(); ++n)
        if (place.lumen.voxels[n]) {
            const Index3 v = place.lumen.grid.indexOf(n);
            use(Index3{v.i + place.low.i, v.j + place.low.j, v.k + place.low.k});
        }
}

void measureLevels(const HuVolume& signal, const LumenInScan& place, SignalLevels& levels)
{
    std::vector<std::int16_t> within, wall;
    forEachOfLumen(place, [&](Index3 v) {
        bool rim = false;
        for (const Index3 way : kFaces) {
            rim = rim || !place.isLumen(along(v, way, 2));
            if (place.isLumen(along(v, way, 1)))
                continue;
            std::int16_t brightest = 0;
            for (int step = 1; step <= kWallReach_voxels; ++step)
                brightest = std::max(brightest, signal.valueOr(along(v, way, step), 0));
            wall.push_back(brightest);
        }
        if (!rim)
            within.push_back(signal.at(v));
    });
    levels.lumen = middleOf(within, levels.lumen);
    levels.tissue = std::max(levels.tissue, middleOf(wall, levels.tissue));
}

}  // namespace

HuVolume onLumenScaleAround(const HuVolume& signal, const HuVolume& scaled, const InsideVolume& lumen,
                            SignalLevels& levels)
{
    if (levels.contrast != LumenContrast::dark)
        return scaled;
    const LumenInScan place{lumen, signal.grid.indexAt(lumen.grid.origin_mm)};
    measureLevels(signal, place, levels);
    const HuVolume own = onLumenScale(signal, levels);
    HuVolume out = scaled;
    tbb::parallel_for(std::size_t(0), out.voxels.size(), [&](std::size_t n) {
        if (out.voxels[n] != kPaddingHu)
            out.voxels[n] = std::max(out.voxels[n], kLeastBeyond);
    });
    constexpr int kNear_voxels = 2;  // no case recorded; reason: the blurred edge of a lumen
    forEachOfLumen(place, [&](Index3 v) {
        out.at(v) = own.at(v);
        for (const Index3 way : kFaces)
            for (int step = 1; step <= kNear_voxels && signal.grid.contains(along(v, way, step)); ++step)
                out.at(along(v, way, step)) = own.at(along(v, way, step));
    });
    return out;
}

}  // namespace vicon::steps
