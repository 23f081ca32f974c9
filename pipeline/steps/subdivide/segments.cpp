#include "subdivide/segments.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "grid/allocate.h"
#include "grid/components.h"
#include "grid/mask.h"

namespace vicon::steps {
namespace {

struct Component {
    std::uint16_t label = 0;
    std::size_t voxels = 0;
    bool kept = false;
    std::uint32_t segment = 0;  ///< the component that it belongs to
};

std::vector<Component> describe(const Components& components, const Grid& grid, std::size_t labels,
                                const std::vector<std::size_t>& anchors)
{
    std::vector<Component> found(components.count());
    for (std::uint32_t n = 0; n < components.count(); ++n)
        found[n].segment = n;
    for (const Run& run : components.runs()) {
        found[run.component].label = run.label;
        found[run.component].voxels += std::size_t(run.end - run.begin);
    }
    for (const std::size_t anchor : anchors)
        found[components.at(grid.indexOf(anchor))].kept = true;
    std::vector<std::uint32_t> largest(labels + 1, std::numeric_limits<std::uint32_t>::max());
    std::vector<bool> anchored(labels + 1, false);
    for (std::uint32_t n = 0; n < found.size(); ++n) {
        auto& best = largest[found[n].label];
        if (best == std::numeric_limits<std::uint32_t>::max() || found[n].voxels > found[best].voxels)
            best = n;
        if (found[n].kept)
            anchored[found[n].label] = true;
    }
    for (std::size_t l = 1; l <= labels; ++l)
        if (!anchored[l] && largest[l] != std::numeric_limits<std::uint32_t>::max())
            found[largest[l]].kept = true;
    return found;
}

/// Gives components that are not kept to a kept one that they touch, layer by layer.
void giveAway(const Components& components, std::vector<Component>& found)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> contact;
    components.forTouchingRuns([&](const Run& a, const Run& b) {
        if (a.component == b.component || (found[a.component].kept && found[b.component].kept))
            return;
        const int shared = std::max(1, std::min(a.end, b.end) - std::max(a.begin, b.begin));
        contact[{a.component, b.component}] += shared;
        contact[{b.component, a.component}] += shared;
    });
    for (bool changed = true; changed;) {
        changed = false;
        std::map<std::uint32_t, std::pair<int, std::uint32_t>> best;
        for (const auto& [pair, shared] : contact)
            if (!found[pair.first].kept && found[pair.second].kept) {
                auto& chosen = best[pair.first];
                if (shared > chosen.first)
                    chosen = {shared, found[pair.second].segment};
            }
        for (const auto& [component, chosen] : best) {
            found[component].kept = true;
            found[component].segment = chosen.second;
            changed = true;
        }
    }
    for (Component& component : found)
        component.kept = true;
}

/// Number of each component's segment, 1.. in order of station.
std::vector<std::uint16_t> numbersFor(const std::vector<Component>& found, const std::vector<LabelledPiece>& pieces,
                                      std::vector<std::uint32_t>& order)
{
    for (std::uint32_t n = 0; n < found.size(); ++n)
        if (found[n].segment == n)
            order.push_back(n);
    if (order.size() > std::numeric_limits<std::uint16_t>::max())
        throw Error(ErrorCode::bad_input, "the lumen falls into more than 65535 segments", {},
                    "raise subdivide.length_mm, or look at the segmentation");
    const auto station = [&](std::uint32_t n) { return pieces[found[n].label - 1U].from_station_mm; };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return station(a) < station(b); });
    std::vector<std::uint16_t> number(found.size());
    for (std::size_t n = 0; n < order.size(); ++n)
        number[order[n]] = std::uint16_t(n + 1);
    for (std::size_t n = 0; n < found.size(); ++n)
        number[n] = number[found[n].segment];
    return number;
}

struct Extent {
    Index3 low{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
    Index3 high{-1, -1, -1};

    void add(const Run& run)
    {
        low = {std::min(low.i, run.begin), std::min(low.j, run.j), std::min(low.k, run.k)};
        high = {std::max(high.i, run.end - 1), std::max(high.j, run.j), std::max(high.k, run.k)};
    }
};

/// The LPS box around the voxels of an extent, to their outer edges.
void setBox(SegmentInfo& info, const Extent& extent, const Grid& grid)
{
    info.lower_mm = {1e300, 1e300, 1e300};
    info.upper_mm = {-1e300, -1e300, -1e300};
    for (int corner = 0; corner < 8; ++corner) {
        const Point3 p = grid.pointAt(ContinuousIndex3{corner & 1 ? extent.high.i + 0.5 : extent.low.i - 0.5,
                                                       corner & 2 ? extent.high.j + 0.5 : extent.low.j - 0.5,
                                                       corner & 4 ? extent.high.k + 0.5 : extent.low.k - 0.5});
        info.lower_mm = {std::min(info.lower_mm.x, p.x), std::min(info.lower_mm.y, p.y),
                         std::min(info.lower_mm.z, p.z)};
        info.upper_mm = {std::max(info.upper_mm.x, p.x), std::max(info.upper_mm.y, p.y),
                         std::max(info.upper_mm.z, p.z)};
    }
}

}  // namespace

NumberedSegments numberSegments(const InsideVolume& inside, const std::vector<std::uint16_t>& label,
                                const std::vector<LabelledPiece>& pieces, const std::vector<std::size_t>& anchors)
{
    const Grid& grid = inside.grid;
    const Components components(grid, label);
    auto found = describe(components, grid, pieces.size(), anchors);
    giveAway(components, found);
    std::vector<std::uint32_t> order;
    const auto number = numbersFor(found, pieces, order);

    NumberedSegments out{makeVolume<std::uint16_t>(grid), {}, {}};
    for (std::size_t n = 0; n < order.size(); ++n) {
        const LabelledPiece& piece = pieces[found[order[n]].label - 1U];
        out.pieces.push_back(piece);
        SegmentInfo info;
        info.number = int(n + 1);
        info.from_station_mm = piece.from_station_mm;
        info.to_station_mm = piece.to_station_mm;
        out.infos.push_back(info);
    }
    std::vector<Extent> extents(order.size());
    for (const Run& run : components.runs()) {
        const std::uint16_t segment = number[run.component];
        auto& info = out.infos[segment - 1U];
        info.inside_voxels += std::size_t(run.end - run.begin);
        extents[segment - 1U].add(run);
        for (int i = run.begin; i < run.end; ++i) {
            out.segments.at({i, run.j, run.k}) = segment;
            info.surface_voxels += besideOther(inside, {i, run.j, run.k});
        }
    }
    for (auto& info : out.infos) {
        info.volume_mm3 = double(info.inside_voxels) * grid.voxelVolume_mm3();
        setBox(info, extents[std::size_t(info.number) - 1], grid);
    }
    return out;
}

}  // namespace vicon::steps
