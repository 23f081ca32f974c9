#include "vicon/steps/segment.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <set>

#include "grid/allocate.h"
#include "segment/binary.h"
#include "segment/body.h"
#include "segment/cut.h"
#include "segment/field_of_view.h"
#include "segment/fluid/fluid.h"
#include "segment/fluid/rim.h"
#include "segment/ileum/ileum_cut.h"
#include "segment/lumen.h"
#include "segment/pieces/bridge_way.h"
#include "segment/pieces/candidates.h"
#include "segment/pieces/ordering.h"
#include "segment/points.h"
#include "segment/verdict.h"
#include "segment/wall/settle_wall.h"
#include "segment/wall/thin_folds.h"

namespace vicon::steps {
namespace {

// Holes in thin walls between pools are smaller than this radius; passages of the colon itself are wider, and gas keeps
// narrower ones open. Chosen on the prone scan of the reference data, where 1.5 mm leaves small bowel attached.
constexpr double kLeak_mm = 3;
// Half-way densities of pools that differ by no more than this lie a tenth of a voxel apart.
constexpr double kSameFluid_hu = 60;
constexpr int kMostCandidates = 10;  // the exact ordering takes 2^n steps
constexpr int kMargin_voxels = 2;
constexpr double kSameEnd_mm = 15;

struct Corrections {
    std::vector<Point3> add, cut, drop;
};

InsideVolume findLumen(const HuVolume& volume, Vector3 gravity, const Body& body, const SegmentOptions& options,
                       const Corrections& corrections, Segmentation& result, Progress& progress)
{
    const RunLabels gas = findGas(volume, body, options.gas_below_hu);
    progress.check();
    InsideVolume labels = labelGas(volume, gas, componentsAt(gas, volume.grid, corrections.add));
    growToWall(volume, options.wall_hu, labels);
    progress.report(0.3, "tagged fluid");
    const FluidDensities densities{options.fluid_above_hu, options.tissue_hu, options.wall_hu};
    const FluidResult fluid = addTaggedFluid(volume, gravity, densities, labels, progress);
    result.measures["noise_hu"] = fluid.noise_hu;
    result.measures["fluid_levels"] = fluid.levels.size();
    for (const Point3 p : corrections.add)
        addFluidAt(volume, p, densities, labels);
    const auto [faintest, brightest] =
        std::minmax_element(fluid.levels.begin(), fluid.levels.end(),
                            [](const FluidLevel& a, const FluidLevel& b) { return a.density_hu < b.density_hu; });
    result.measures["fluid_faintest_hu"] = fluid.levels.empty() ? 0 : faintest->density_hu;
    result.measures["fluid_brightest_hu"] = fluid.levels.empty() ? 0 : brightest->density_hu;
    return labels;
}

/// The parts that a person's cuts separate from the larger rest.
std::set<int> separated(const RunLabels& lumen, const std::vector<std::vector<Index3>>& around_cuts)
{
    std::set<int> dropped;
    for (const auto& around : around_cuts) {
        std::set<int> parts;
        for (const Index3 v : around)
            if (const int label = lumen.labelAt(v); label >= 0)
                parts.insert(label);
        const auto largest = std::max_element(parts.begin(), parts.end(), [&](int a, int b) {
            return lumen.components[std::size_t(a)].voxels < lumen.components[std::size_t(b)].voxels;
        });
        for (const int part : parts)
            if (part != *largest)
                dropped.insert(part);
    }
    return dropped;
}

/// The scan's part around the chosen components, with their labels.
InsideVolume cropTo(const InsideVolume& labels, const RunLabels& lumen, const std::set<int>& chosen, int margin)
{
    Index3 lower = {1 << 30, 1 << 30, 1 << 30}, upper{-1, -1, -1};
    for (const int n : chosen) {
        const RunComponent& c = lumen.components[std::size_t(n)];
        lower = {std::min(lower.i, c.lower.i), std::min(lower.j, c.lower.j), std::min(lower.k, c.lower.k)};
        upper = {std::max(upper.i, c.upper.i), std::max(upper.j, c.upper.j), std::max(upper.k, c.upper.k)};
    }
    lower = {std::max(0, lower.i - margin), std::max(0, lower.j - margin), std::max(0, lower.k - margin)};
    Grid grid = labels.grid;
    grid.size = {std::min(labels.grid.size[0], upper.i + margin + 1) - lower.i,
                 std::min(labels.grid.size[1], upper.j + margin + 1) - lower.j,
                 std::min(labels.grid.size[2], upper.k + margin + 1) - lower.k};
    grid.origin_mm = labels.grid.pointAt(lower);
    auto out = makeVolume<std::uint8_t>(grid);
    tbb::parallel_for(0, grid.size[2], [&](int k) {
        for (int j = 0; j < grid.size[1]; ++j)
            for (int i = 0; i < grid.size[0]; ++i)
                if (labels.at({lower.i + i, lower.j + j, lower.k + k}) == kRim)
                    out.at({i, j, k}) = kRim;
    });
    lumen.forEachRun([&](const VoxelRun& run, int j, int k) {
        if (!chosen.contains(int(run.label)))
            return;
        const std::uint8_t* from = &labels.at({run.begin, j, k});
        std::copy_n(from, run.end - run.begin, &out.at({run.begin - lower.i, j - lower.j, k - lower.k}));
    });
    return out;
}

LumenPiece pieceFor(const Candidate& c, bool reversed)
{
    return {
        c.tip_mm[reversed ? 1 : 0], c.tip_mm[reversed ? 0 : 1], c.volume_ml, c.fluid_ml, c.length_mm, c.max_radius_mm};
}

nlohmann::json describe(const std::vector<Candidate>& candidates, const Ordering& ordering)
{
    nlohmann::json out = nlohmann::json::array();
    for (std::size_t n = 0; n < candidates.size(); ++n) {
        const Candidate& c = candidates[n];
        const auto at = std::find_if(ordering.pieces.begin(), ordering.pieces.end(),
                                     [&](const OrderedPiece& p) { return p.candidate == int(n); });
        out.push_back({{"volume_ml", c.volume_ml},
                       {"fluid_ml", c.fluid_ml},
                       {"length_mm", c.length_mm},
                       {"max_radius_mm", c.max_radius_mm},
                       {"looks_like", c.kind},
                       {"place_in_colon", at == ordering.pieces.end() ? 0 : at - ordering.pieces.begin() + 1}});
    }
    return out;
}

/// The way ends in the colon where the lumen runs on as a narrow tube.
void endBeforeIleum(const std::vector<IleumCut>& ilea, LumenPiece& last)
{
    for (const IleumCut& ileum : ilea)
        if (ileum.shorter_mm > 0 && distance(ileum.end_mm, last.caecal_end_mm) < kSameEnd_mm) {
            last.caecal_end_mm = ileum.moved_end_mm;
            last.length_mm -= ileum.shorter_mm;
            return;
        }
}

/// What a person must know of the ends where ileum was sought.
void describeIlea(const std::vector<IleumCut>& ilea, Segmentation& result)
{
    const Point3 end = result.plan.pieces.empty() ? Point3{} : result.plan.pieces.back().caecal_end_mm;
    for (const IleumCut& ileum : ilea)
        if (ileum.cut || distance(ileum.end_mm, end) < kSameEnd_mm ||
            (ileum.shorter_mm > 0 && distance(ileum.moved_end_mm, end) < kSameEnd_mm))
            note(result, ileum.reason);
    nlohmann::json& list = result.measures["ileum"] = nlohmann::json::array();
    for (const IleumCut& ileum : ilea)
        if (ileum.cut)
            list.push_back({{"valve_mm", {ileum.valve_mm.x, ileum.valve_mm.y, ileum.valve_mm.z}},
                            {"neck_radius_mm", ileum.neck_mm},
                            {"removed_ml", ileum.removed_ml}});
}

Segmentation segmentAutomatically(const HuVolume& volume, Vector3 gravity, const SegmentOptions& options,
                                  Progress& progress)
{
    const Corrections corrections{parsePoints(options.add, "segment.add"), parsePoints(options.cut, "segment.cut"),
                                  parsePoints(options.drop, "segment.drop")};
    progress.report(0, "body");
    const Body body = findBody(volume, progress);
    if (body.empty())
        return noColon("there is no body in the scan");
    Segmentation result;
    progress.report(0.1, "gas");
    InsideVolume labels = findLumen(volume, gravity, body, options, corrections, result, progress);
    progress.report(0.5, "pieces");
    std::vector<std::vector<Index3>> around_cuts;
    for (const Point3 p : corrections.cut)
        around_cuts.push_back(cutAcross(labels, p, progress));
    const int layers = rimLayers(labels.grid, kLeak_mm);
    markFluidRim(labels, layers);
    RunLabels lumen = labelLumen(labels, Neighbours::faces);
    const auto candidatesIn = [&](const std::vector<int>& always) {
        return findCandidates(labels, lumen, body, options.smallest_piece_ml, kMostCandidates, always, progress);
    };
    std::vector<Candidate> candidates = candidatesIn(componentsAt(lumen, labels.grid, corrections.add));
    const std::vector<IleumCut> ilea = cutIlea(labels, candidates, layers, corrections.add, body, progress);
    const bool cut = std::any_of(ilea.begin(), ilea.end(), [](const IleumCut& ileum) { return ileum.cut; });
    if (cut)
        lumen = labelLumen(labels, Neighbours::faces);
    std::set<int> dropped = separated(lumen, around_cuts);
    for (const int n : componentsAt(lumen, labels.grid, corrections.drop))
        dropped.insert(n);
    const std::vector<int> added = componentsAt(lumen, labels.grid, corrections.add);
    std::vector<Point3> unmet;
    std::copy_if(corrections.add.begin(), corrections.add.end(), std::back_inserter(unmet),
                 [&](Point3 p) { return componentsAt(lumen, labels.grid, {p}).empty(); });
    if (cut)
        candidates = candidatesIn(added);
    std::erase_if(candidates, [&](const Candidate& c) { return dropped.contains(int(c.label)); });
    const int rectum = findRectum(candidates, body, options.catheter_radius_mm, progress);
    if (rectum < 0)
        return noColon("there is no gas in the body that is wide enough for a rectum");
    std::vector<int> required;
    for (std::size_t n = 0; n < candidates.size(); ++n)
        if (std::find(added.begin(), added.end(), int(candidates[n].label)) != added.end())
            required.push_back(int(n));
    progress.report(0.8, "order of the pieces");
    const Ordering ordering = orderPieces(
        candidates, rectum, required, body, labels,
        [&](Point3 from, Point3 to) { return fatBetween_mm(volume, labels, from, to, progress); },
        options.longest_sure_bridge_mm, progress);
    std::set<int> chosen;
    for (const OrderedPiece& p : ordering.pieces) {
        const Candidate& c = candidates[std::size_t(p.candidate)];
        chosen.insert(int(c.label));
        result.plan.pieces.push_back(pieceFor(c, p.reversed));
    }
    result.plan.bridges = ordering.bridges;
    endBeforeIleum(ilea, result.plan.pieces.back());
    result.inside = cropTo(labels, lumen, chosen, kMargin_voxels + layers);
    restoreFluidRim(result.inside, layers);
    const WallField::Levels levels{options.wall_hu, options.tissue_hu};
    if (result.measures["fluid_faintest_hu"] < result.measures["fluid_brightest_hu"].get<double>() - kSameFluid_hu)
        settleFluidWall(volume, levels, int(chosen.size()), result.inside);
    keepThinFolds(volume, levels, int(chosen.size()), result.inside);
    followCords(volume, result.inside, options.longest_sure_bridge_mm, result.plan, progress);
    result.measures["candidates"] = describe(candidates, ordering);
    judgeSegmentation(result, body, lumenCut_mm2(volume, result.inside));
    describeIlea(ilea, result);
    for (const Point3 p : unmet)
        note(result, "there is no gas or fluid at the seed " + textOf(p));
    return result;
}

}  // namespace

Segmentation segmentColon(const HuVolume& volume, Vector3 gravity, const SegmentOptions& options, Progress& progress)
{
    Segmentation result = options.method == "binary" ? segmentBinary(volume, options, progress)
                                                     : segmentAutomatically(volume, gravity, options, progress);
    const double voxel_ml = result.inside.grid.voxelVolume_mm3() / 1000;
    const auto count = [&](std::uint8_t label) {
        return double(std::count(result.inside.voxels.begin(), result.inside.voxels.end(), label)) * voxel_ml;
    };
    result.measures["gas_ml"] = count(kGas);
    result.measures["fluid_ml"] = count(kFluid);
    result.measures["pieces"] = result.plan.pieces.size();
    result.measures["bridges"] = toJson(result.plan)["bridges"];
    progress.report(1, "segmented");
    return result;
}

}  // namespace vicon::steps
