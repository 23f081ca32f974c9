#include "segment/pieces/candidates.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "grid/check_only.h"
#include "grid/neighbours.h"
#include "segment/fluid/rim.h"
#include "segment/pieces/lumen_ways.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

// No case recorded; reason: sizes of anatomy, held by chain_family_test on seeds that nothing was chosen on. Half and
// double keep the lumen of the three cases (CONTRIBUTING.md), but for half of kSmallBowelRadius_mm: it takes small
// bowel of ctc-prone for colon. The centreline's ends may lie elsewhere: up to 53 mm in ctc-prone with half of
// kRimReach.
constexpr double kRectumRadius_mm = 5;         // a rectal tube is narrower, a rectum with gas wider
constexpr double kSmallBowelRadius_mm = 8;     // gas-filled small bowel is rarely wider than 16 mm across
constexpr std::size_t kLarge_voxels = 400000;  // at half resolution small pieces are cheap, large ones wide
constexpr int kRimReach = 4;                   // voxels by which a component grows when it gets its rim back
constexpr double kTipReach_mm = 40;            // of the lumen beside a tip that tells whether it is a narrow tube
constexpr double kMidline_mm = 45;             // the rectum's lower end lies nearer to the body's middle plane

Point3 lowerCorner(Point3 a, Point3 b)
{
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Point3 upperCorner(Point3 a, Point3 b)
{
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

void judge(Candidate& c, const Body& body)
{
    const double middle_x = (body.lower_mm.x + body.upper_mm.x) / 2;
    const Point3 centre = interpolate(c.lower_mm, c.upper_mm, 0.5);
    const double height = (centre.z - body.lower_mm.z) / std::max(1.0, body.upper_mm.z - body.lower_mm.z);
    const bool short_for_width = c.length_mm < 6 * c.max_radius_mm;
    if (c.max_radius_mm < kSmallBowelRadius_mm) {
        c.kind = CandidateKind::narrow;
        c.colon_likeness = 0;  // taken only as a stepping stone over a collapsed part
    } else if (short_for_width && c.max_radius_mm > 20 && centre.x > middle_x && height > 0.55) {
        c.kind = CandidateKind::stomach;
        c.colon_likeness = 0.1;
    }
    if (c.volume_ml > 0 && c.fluid_ml / c.volume_ml > 0.95)
        c.colon_likeness *= 0.3;
}

/// Turns the counts of a half-resolution mask into labels: blocks of which half belongs to the component, and blocks of
/// rim within two steps of them, to which restoreFluidRim() will give the rim back.
void takeRim(InsideVolume& mask)
{
    std::vector<std::size_t> rim;
    for (std::size_t n = 0; n < mask.voxels.size(); ++n) {
        const int own = mask.voxels[n] & 15, with_rim = own + (mask.voxels[n] >> 4);
        mask.voxels[n] = own >= 4 ? kGas : kOutside;
        if (own < 4 && with_rim >= 4)
            rim.push_back(n);
    }
    for (int layer = 0; layer < 2; ++layer) {
        std::vector<std::size_t> taken;
        std::erase_if(rim, [&](std::size_t n) {
            bool touches = false;
            forEachOverFaces(mask.grid, n, [&](std::size_t m) { touches = touches || mask.voxels[m] != 0; });
            if (touches)
                taken.push_back(n);
            return touches;
        });
        for (const std::size_t n : taken)
            mask.voxels[n] = kFluid;
    }
}

/// The graph of a component, with the rim of fluid that belongs to it, at half resolution.
LumenGraph halfGraph(const InsideVolume& labels, const RunLabels& lumen, std::uint32_t label, Progress& progress)
{
    const Grid& grid = labels.grid;
    const RunComponent& component = lumen.components[label];
    const Index3 lower{std::max(0, component.lower.i - kRimReach), std::max(0, component.lower.j - kRimReach),
                       std::max(0, component.lower.k - kRimReach)};
    const Index3 upper{std::min(grid.size[0] - 1, component.upper.i + kRimReach),
                       std::min(grid.size[1] - 1, component.upper.j + kRimReach),
                       std::min(grid.size[2] - 1, component.upper.k + kRimReach)};
    Grid half = grid;
    half.size = {(upper.i - lower.i) / 2 + 1, (upper.j - lower.j) / 2 + 1, (upper.k - lower.k) / 2 + 1};
    half.origin_mm = grid.pointAt(ContinuousIndex3{lower.i + 0.5, lower.j + 0.5, lower.k + 0.5});
    for (double& spacing : half.spacing_mm)
        spacing *= 2;
    InsideVolume mask(half);  // voxels of the component in the low four bits, of the rim in the high ones
    tbb::parallel_for(0, half.size[2], [&](int hk) {
        for (int k = lower.k + 2 * hk; k <= std::min(upper.k, lower.k + 2 * hk + 1); ++k)
            for (int j = lower.j; j <= upper.j; ++j) {
                std::uint8_t* out = &mask.at({0, (j - lower.j) / 2, hk});
                for (std::size_t r = lumen.row_begin[lumen.row(j, k)]; r < lumen.row_begin[lumen.row(j, k) + 1]; ++r)
                    for (int i = lumen.runs[r].begin; lumen.runs[r].label == label && i < lumen.runs[r].end; ++i)
                        ++out[(i - lower.i) / 2];
                const std::uint8_t* row = &labels.voxels[grid.offset({0, j, k})];
                for (int i = lower.i; i <= upper.i; ++i)
                    if (row[i] == kRim)
                        out[(i - lower.i) / 2] = std::uint8_t(out[(i - lower.i) / 2] + 16);
            }
    });
    takeRim(mask);
    return makeWholeGraph(wallDistance(mask, progress), component.voxels > kLarge_voxels ? 2 : 1, progress);
}

/// The widest radius within kTipReach_mm of either end of a way.
void measureTips(Candidate& candidate, const LumenWay& way)
{
    for (const std::int32_t n : way.nodes) {
        const double from_one = way.tree.length_mm[std::size_t(n)];
        for (const int tip : {0, 1})
            if ((tip == 0 ? from_one : candidate.length_mm - from_one) < kTipReach_mm)
                candidate.tip_radius_mm[tip] =
                    std::max(candidate.tip_radius_mm[tip], double(candidate.graph.node(n).wall_mm));
    }
}

/// Keeps what a way reaches of a component of which several lead through.
void keepPart(Candidate& candidate, const LumenWay& way)
{
    const LumenGraph& graph = candidate.graph;
    std::size_t own = 0;
    candidate.barred.resize(graph.count(), 0);
    candidate.max_radius_mm = 0;
    candidate.lower_mm = candidate.upper_mm = graph.point(way.tree.root);
    for (std::size_t n = 0; n < graph.count(); ++n) {
        if (!way.tree.reaches(std::int32_t(n))) {
            candidate.barred[n] = 1;
            continue;
        }
        ++own;
        const Point3 p = graph.point(std::int32_t(n));
        candidate.max_radius_mm = std::max(candidate.max_radius_mm, double(graph.nodes[n].wall_mm));
        candidate.lower_mm = lowerCorner(candidate.lower_mm, p);
        candidate.upper_mm = upperCorner(candidate.upper_mm, p);
    }
    const double share = double(own) / double(graph.count());
    candidate.volume_ml *= share;
    candidate.fluid_ml *= share;
}

/// What a component is: one candidate, or several where loops hang together by a contact alone.
std::vector<Candidate> describe(const InsideVolume& labels, const RunLabels& lumen, std::uint32_t label,
                                Progress& progress)
{
    const Grid& grid = labels.grid;
    const RunComponent& component = lumen.components[label];
    const double voxel_ml = grid.voxelVolume_mm3() / 1000;
    Candidate whole;
    whole.label = label;
    whole.volume_ml = double(component.voxels) * voxel_ml;
    whole.fluid_ml = component.sum * voxel_ml;
    const Point3 a = grid.pointAt(component.lower), b = grid.pointAt(component.upper);
    whole.lower_mm = lowerCorner(a, b);
    whole.upper_mm = upperCorner(a, b);
    whole.graph = halfGraph(labels, lumen, label, progress);
    if (whole.graph.count() == 0)
        return {whole};
    whole.max_radius_mm = whole.graph.node(widestNode(whole.graph)).wall_mm;
    const LumenWays found = findWays(whole.graph, progress);
    whole.barred = found.barred;
    std::vector<Candidate> candidates(found.ways.size(), whole);
    for (std::size_t n = 0; n < candidates.size(); ++n) {
        Candidate& candidate = candidates[n];
        const LumenWay& way = found.ways[n];
        if (candidates.size() > 1)
            keepPart(candidate, way);
        candidate.length_mm = way.length_mm();
        candidate.tip_mm[0] = whole.graph.point(way.nodes.front());
        candidate.tip_mm[1] = whole.graph.point(way.nodes.back());
        measureTips(candidate, way);
    }
    return candidates;
}

}  // namespace

FoundCandidates findCandidates(const InsideVolume& labels, const RunLabels& lumen, const Body& body, double smallest_ml,
                               int most, const std::vector<int>& always, Progress& progress)
{
    const double voxel_ml = labels.grid.voxelVolume_mm3() / 1000;
    const auto isAsked = [&](std::uint32_t n) {
        return std::find(always.begin(), always.end(), int(n)) != always.end();
    };
    std::vector<std::uint32_t> large;
    for (std::size_t n = 0; n < lumen.components.size(); ++n)
        if (double(lumen.components[n].voxels) * voxel_ml >= smallest_ml || isAsked(std::uint32_t(n)))
            large.push_back(std::uint32_t(n));
    std::stable_sort(large.begin(), large.end(), [&](std::uint32_t a, std::uint32_t b) {
        return isAsked(a) != isAsked(b) ? isAsked(a) : lumen.components[a].voxels > lumen.components[b].voxels;
    });
    FoundCandidates found;
    found.left_out = int(large.size()) - std::min(int(large.size()), most);
    large.resize(large.size() - std::size_t(found.left_out));
    std::vector<std::vector<Candidate>> of_component(large.size());
    tbb::parallel_for(std::size_t(0), large.size(), [&](std::size_t n) {
        CheckOnly check(progress);
        of_component[n] = describe(labels, lumen, large[n], check);
        for (Candidate& candidate : of_component[n])
            judge(candidate, body);
    });
    progress.check();
    for (std::vector<Candidate>& some : of_component) {
        if (found.candidates.size() + some.size() > std::size_t(kMostCandidates)) {
            ++found.left_out;
            continue;
        }
        std::move(some.begin(), some.end(), std::back_inserter(found.candidates));
    }
    return found;
}

int findRectum(std::vector<Candidate>& candidates, const Body& body, double catheter_radius_mm, Progress& progress)
{
    const double middle_x = (body.lower_mm.x + body.upper_mm.x) / 2;
    int best = -1;
    double lowest = 1e300;
    std::int32_t end = -1;
    for (std::size_t n = 0; n < candidates.size(); ++n) {
        const Candidate& c = candidates[n];
        if (c.max_radius_mm < kRectumRadius_mm || c.lower_mm.z > lowest)
            continue;
        for (std::size_t node = 0; node < c.graph.count(); ++node) {
            if (!c.barred.empty() && c.barred[node])
                continue;
            if (c.graph.nodes[node].wall_mm < std::max(catheter_radius_mm, kRectumRadius_mm))
                continue;
            const Point3 p = c.graph.point(std::int32_t(node));
            const double score = p.z + 2 * std::max(0.0, std::abs(p.x - middle_x) - kMidline_mm);
            if (score < lowest) {
                lowest = score;
                best = int(n);
                end = std::int32_t(node);
            }
        }
    }
    if (best < 0)
        return best;
    Candidate& rectum = candidates[std::size_t(best)];
    const LumenTree tree = centralTree(rectum.graph, end, rectum.barred, progress);
    const std::int32_t far = farthestNode(tree);
    rectum.tip_mm[0] = rectum.graph.point(end);
    rectum.tip_mm[1] = rectum.graph.point(far);
    rectum.length_mm = tree.length_mm[std::size_t(far)];
    return best;
}

}  // namespace vicon::steps
