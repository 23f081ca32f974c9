#include "skeleton/rectal_tube.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "grid/voxel_box.h"
#include "vicon/steps/largest.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

// No case recorded; reason: sizes of rectal tubes and rectums. Half and double leave the three cases (CONTRIBUTING.md)
// as they are, but for kTubeReach_mm, which moves the start of ways of equal cost.
constexpr double kTubeReach_mm = 150;     // from the rectal end: a rectal tube lies no higher
constexpr double kTubeSection_mm2 = 200;  // of a tube of up to 12 mm, cut obliquely
// Of a section: the area of a tube 6 mm wide allows no more. Chosen on the loops of loop_contacts_test.cpp: between a
// hole and a bend lumen surrounds the wall of two loops too.
constexpr double kTubeLongest_mm = 35;
constexpr double kMargin_mm = 24;  // about the tube: hardly a rectum is wider; what is wider is tried again

/// The lumen's bounds in a slice.
VoxelBox lumenIn(const InsideVolume& inside, int k)
{
    const int columns = inside.grid.size[0], rows = inside.grid.size[1];
    VoxelBox box;
    for (int j = 0; j < rows; ++j) {
        const auto row = inside.voxels.begin() + std::ptrdiff_t(inside.grid.offset({0, j, k})), end = row + columns;
        const auto lumen = [](std::uint8_t label) { return label != kOutside; };
        const auto first = std::find_if(row, end, lumen);
        if (first == end)
            continue;
        const auto last = std::find_if(std::make_reverse_iterator(end), std::make_reverse_iterator(row), lumen);
        box.take({int(first - row), j, k});
        box.take({int(last.base() - row) - 1, j, k});
    }
    return box;
}

/// Whether an island of a slice is longer than any section of a tube.
bool tooLong(const std::vector<Index3>& island, const Grid& grid)
{
    VoxelBox box;
    for (const Index3 v : island)
        box.take(v);
    return std::hypot((box.high.i - box.low.i) * grid.spacing_mm[0], (box.high.j - box.low.j) * grid.spacing_mm[1]) >
           kTubeLongest_mm;
}

/// Islands of no lumen in a slice, up to `most` pixels and as long as a tube's section may be, that lumen surrounds.
std::vector<Index3> islandsIn(const InsideVolume& inside, int k, std::size_t most)
{
    const VoxelBox box = lumenIn(inside, k);
    if (box.empty())
        return {};
    const int width = box.high.i - box.low.i;
    std::vector<std::uint8_t> seen(std::size_t(width) * std::size_t(box.high.j - box.low.j), 0);
    std::vector<Index3> island, all;
    for (int j = box.low.j; j < box.high.j; ++j)
        for (int i = box.low.i; i < box.high.i; ++i) {
            island.clear();
            bool open = false;
            const auto take = [&](int a, int b) {
                if (a < box.low.i || b < box.low.j || a >= box.high.i || b >= box.high.j) {
                    open = true;
                    return;
                }
                std::uint8_t& known =
                    seen[std::size_t(b - box.low.j) * std::size_t(width) + std::size_t(a - box.low.i)];
                if (!known && !inside.at({a, b, k})) {
                    known = 1;
                    island.push_back({a, b, k});
                }
            };
            take(i, j);
            for (std::size_t n = 0; n < island.size(); ++n) {
                const Index3 v = island[n];
                take(v.i - 1, v.j);
                take(v.i + 1, v.j);
                take(v.i, v.j - 1);
                take(v.i, v.j + 1);
            }
            if (!open && island.size() <= most && !tooLong(island, inside.grid))
                all.insert(all.end(), island.begin(), island.end());
        }
    return all;
}

std::vector<Index3> tubeIn(const InsideVolume& inside, Point3 rectal_end_mm)
{
    const auto& spacing = inside.grid.spacing_mm;
    const auto most = std::size_t(kTubeSection_mm2 / (spacing[0] * spacing[1]));
    const int end = inside.grid.indexAt(rectal_end_mm).k, reach = int(kTubeReach_mm / spacing[2]);
    const int from = std::clamp(end - reach, 0, inside.grid.size[2]),
              to = std::clamp(end + reach + 1, from, inside.grid.size[2]);
    std::vector<std::vector<Index3>> slices(std::size_t(to - from));
    tbb::parallel_for(from, to, [&](int k) { slices[std::size_t(k - from)] = islandsIn(inside, k, most); });
    std::vector<Index3> tube;
    for (const auto& slice : slices)
        tube.insert(tube.end(), slice.begin(), slice.end());
    return tube;
}

}  // namespace

FieldVolume wallDistanceOverTube(const InsideVolume& inside, Point3 rectal_end_mm, Progress& progress)
{
    const std::vector<Index3> tube = tubeIn(inside, rectal_end_mm);
    VoxelBox about;
    for (const Index3 v : tube)
        about.take(v);
    if (about.empty())
        return {};
    const double voxel_mm = *std::min_element(inside.grid.spacing_mm.begin(), inside.grid.spacing_mm.end());
    for (double margin_mm = kMargin_mm;; margin_mm *= 2) {
        const int margin = int(std::ceil(margin_mm / voxel_mm));
        const VoxelBox changed = about.grown(margin, inside.grid), seen = changed.grown(margin, inside.grid);
        InsideVolume part = cropped(inside, seen);
        for (const Index3 v : tube)
            part.at({v.i - seen.low.i, v.j - seen.low.j, v.k - seen.low.k}) = kGas;
        const FieldVolume open_mm = wallDistance(part, progress);
        // Lumen that is not as wide as the margin meets its wall within the box, and has none of the tube beyond it.
        if (largestOf(open_mm) < margin_mm - voxel_mm ||
            changed == VoxelBox{{0, 0, 0}, {inside.grid.size[0], inside.grid.size[1], inside.grid.size[2]}})
            return cropped(open_mm,
                           {{changed.low.i - seen.low.i, changed.low.j - seen.low.j, changed.low.k - seen.low.k},
                            {changed.high.i - seen.low.i, changed.high.j - seen.low.j, changed.high.k - seen.low.k}});
    }
}

}  // namespace vicon::steps
