#include "subdivide/thesis/subdivision.h"

#include <vtkMarchingCubesTriangleCases.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "grid/lumen_front.h"
#include "grid/mask.h"
#include "subdivide/thesis/choice.h"
#include "subdivide/thesis/walk.h"
#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

using Labels = LumenFront::Labels;

/// Triangles of each of the 256 ways in which eight voxels are inside or outside. The mask alone decides the way, so
/// sums over voxels are the triangles that the surface will have.
std::array<int, 256> trianglesOfCases()
{
    std::array<int, 256> count{};
    const vtkMarchingCubesTriangleCases* cases = vtkMarchingCubesTriangleCases::GetCases();
    for (std::size_t c = 0; c < count.size(); ++c)
        while (cases[c].edges[std::ptrdiff_t{3} * count[c]] >= 0)
            ++count[c];
    return count;
}

/// What a voxel adds to the size of its segment, by the criterion.
class VoxelSize {
public:
    VoxelSize(const InsideVolume& inside, SegmentSize criterion)
        : inside_(inside), criterion_(criterion), triangles_(trianglesOfCases())
    {
    }

    double of(Index3 v) const
    {
        if (criterion_ == SegmentSize::inside)
            return 1;
        if (criterion_ == SegmentSize::surface)
            return besideOther(inside_, v) ? 1 : 0;
        int sum = 0;
        for (int n = 0; n < 8; ++n)
            sum += trianglesOfCube({v.i - (n & 1), v.j - (n >> 1 & 1), v.k - (n >> 2)}, v);
        return sum;
    }

private:
    /// Triangles of the cube of eight voxels from `low` on, if `owner` is its first inside voxel; else 0.
    int trianglesOfCube(Index3 low, Index3 owner) const
    {
        // VTK numbers a cube's corners around its lower face, then around its upper one.
        constexpr int kCorner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                       {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
        std::size_t way = 0;
        bool first = true;
        for (int n = 0; n < 8; ++n) {
            const Index3 w{low.i + kCorner[n][0], low.j + kCorner[n][1], low.k + kCorner[n][2]};
            if (!inside_.valueOr(w, kOutside)) {
                way |= std::size_t(1) << n;  // outside has the higher value
                continue;
            }
            if (first && w != owner)
                return 0;
            first = false;
        }
        return triangles_[way];
    }

    const InsideVolume& inside_;
    SegmentSize criterion_;
    std::array<int, 256> triangles_;
};

/// The sizes along every path: each voxel of the lumen counts at the path voxel whose front reaches it first.
std::vector<PathSizes> sizesAlong(const InsideVolume& inside, const std::vector<Path>& paths, SegmentSize criterion,
                                  int segments)
{
    LumenFront front(inside);
    std::vector<std::size_t> first;
    std::size_t count = 0;
    for (const Path& path : paths) {
        first.push_back(count);
        for (const PathVoxel& v : path.voxels)
            front.seed(v.voxel, 0, std::uint16_t(std::min<std::size_t>(++count, 65535)));
    }
    front.run(Labels::adopt);
    front.runOverCorners(Labels::adopt);
    const std::vector<std::uint16_t> label = front.labels();
    std::vector<double> size(count + 1, 0);
    const VoxelSize measure(inside, criterion);
    for (std::size_t n = 0; n < inside.voxels.size(); ++n)
        if (inside.voxels[n] && label[n] && label[n] <= count)
            size[label[n]] += measure.of(inside.grid.indexOf(n));
    double total = 0;
    for (const double s : size)
        total += s;
    std::vector<PathSizes> sizes(paths.size());
    for (std::size_t p = 0; p < paths.size(); ++p) {
        double sum = 0;
        for (std::size_t n = 0; n < paths[p].voxels.size(); ++n)
            sizes[p].up_to.push_back(sum += size[first[p] + n + 1]);
        sizes[p].target = std::max(1.0, total / segments);
    }
    return sizes;
}

/// Gives unlabelled inside voxels the label of the nearest labelled ones, counted in steps between 26-neighbours.
void fillIn(const InsideVolume& inside, std::vector<std::uint16_t>& label)
{
    const Grid& grid = inside.grid;
    std::vector<std::uint32_t> open;
    for (std::size_t n = 0; n < label.size(); ++n)
        if (inside.voxels[n] && !label[n])
            open.push_back(std::uint32_t(n));
    for (bool changed = true; changed && !open.empty();) {
        std::vector<std::pair<std::uint32_t, std::uint16_t>> found;
        for (const std::uint32_t voxel : open) {
            const Index3 v = grid.indexOf(voxel);
            for (int s = 0; s < 27; ++s) {
                const Index3 w{v.i + s % 3 - 1, v.j + s / 3 % 3 - 1, v.k + s / 9 - 1};
                if (grid.contains(w) && label[grid.offset(w)]) {
                    found.emplace_back(voxel, label[grid.offset(w)]);
                    break;
                }
            }
        }
        for (const auto& [voxel, l] : found)
            label[voxel] = l;
        changed = !found.empty();
        std::erase_if(open, [&](std::uint32_t voxel) { return label[voxel] != 0; });
    }
}

std::uint16_t newLabel(Labelling& labelling, LabelledPiece piece)
{
    if (labelling.pieces.size() >= std::numeric_limits<std::uint16_t>::max())
        throw Error(ErrorCode::bad_input, "the lumen falls into more than 65535 segments", {},
                    "specify fewer segments, or look at the segmentation");
    labelling.pieces.push_back(piece);
    return std::uint16_t(labelling.pieces.size());
}

/// The lumen between the portals: the portals' voxels are taken out, what is left is flooded from the path's pieces,
/// and each portal goes to the segment before it.
Labelling cutAt(const InsideVolume& inside, const Skeleton& skeleton, const std::vector<Path>& paths,
                const std::vector<std::vector<CutPlane>>& portals)
{
    InsideVolume open = inside;
    for (const auto& of_path : portals)
        for (const CutPlane& portal : of_path)
            for (const std::uint32_t voxel : portal.voxels)
                open.voxels[voxel] = kOutside;
    Labelling labelling;
    LumenFront front(open);
    std::vector<std::pair<const CutPlane*, std::uint16_t>> owners;
    for (std::size_t p = 0; p < paths.size(); ++p) {
        const auto& voxels = paths[p].voxels;
        const auto& curve = skeleton.pieces[std::size_t(paths[p].piece)].points;
        std::size_t from = 0;
        for (std::size_t c = 0; c <= portals[p].size(); ++c) {
            const bool cut = c < portals[p].size();
            const std::size_t to = cut ? portals[p][c].at : voxels.size() - 1;
            const double begin = from == 0 ? curve.front().station_mm : voxels[from].station_mm;
            const double end = cut ? voxels[to].station_mm : curve.back().station_mm;
            const std::uint16_t label = newLabel(labelling, {begin, end, paths[p].piece});
            for (std::size_t n = from; n <= to; ++n)
                front.seed(voxels[n].voxel, 0, label);
            if (cut)
                owners.emplace_back(&portals[p][c], label);
            from = to;
        }
    }
    front.run(Labels::adopt);
    labelling.label = front.labels();
    for (const auto& [portal, label] : owners)
        for (const std::uint32_t voxel : portal->voxels)
            labelling.label[voxel] = label;
    fillIn(inside, labelling.label);
    return labelling;
}

/// What no label reached has no way to any path: each such part gets a label of its own.
void labelSeparateParts(const InsideVolume& inside, const Skeleton& skeleton, Labelling& labelling)
{
    for (std::size_t n = 0; n < inside.voxels.size(); ++n) {
        if (!inside.voxels[n] || labelling.label[n])
            continue;
        const double station = skeleton.nearest(inside.grid.pointAt(inside.grid.indexOf(n))).station_mm;
        labelling.label[n] = newLabel(labelling, {station, station, -1});
        fillIn(inside, labelling.label);
    }
}

}  // namespace

ThesisPieces thesisPieces(const InsideVolume& inside, const Skeleton& skeleton, const std::vector<Path>& paths,
                          const SubdivideOptions& options, int segments, Progress& progress)
{
    const auto sizes = sizesAlong(inside, paths, options.size, segments);
    std::vector<std::vector<CutPlane>> portals;
    PortalChoice costs;
    for (std::size_t p = 0; p < paths.size(); ++p) {
        const CutPlanes cuts(inside, skeleton, paths[p], options);
        const PlanesAt planes = [&cuts](std::size_t n) { return cuts.at(n); };
        if (options.approach == SubdivideApproach::global) {
            PortalChoice choice = choosePortals(planes, sizes[p], progress);
            costs.cost += choice.cost;
            costs.at_least += choice.at_least;
            costs.neighbours_only += choice.neighbours_only;
            portals.push_back(std::move(choice.planes));
        } else {
            portals.push_back(walkLocally(planes, sizes[p], progress));
        }
        progress.report(0.5 * double(p + 1) / double(paths.size()), "subdividing");
    }
    ThesisPieces pieces{cutAt(inside, skeleton, paths, portals)};
    labelSeparateParts(inside, skeleton, pieces.labelling);
    if (options.approach == SubdivideApproach::global)
        pieces.measures = {{"choice_cost", costs.cost},
                           {"choice_cost_at_least", costs.at_least},
                           {"choice_cost_neighbours_only", costs.neighbours_only}};
    return pieces;
}

}  // namespace vicon::steps
