#include "segment/automatic.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <set>

#include "grid/allocate.h"
#include "grid/voxel_box.h"
#include "segment/body.h"
#include "segment/constants.h"
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

// Held by chain_family_test; which cases they were chosen on is not recorded.
// Half-way densities of pools that differ by no more than this lie a tenth of a voxel apart.
constexpr double kSameFluid_hu = 60;
constexpr int kMostCandidates = 10;  // the exact ordering takes 2^n steps
constexpr double kSameEnd_mm = 15;   // between ends of the lumen: nearer, they are one

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
    VoxelBox box;
    for (const int n : chosen) {
        box.take(lumen.components[std::size_t(n)].lower);
        box.take(lumen.components[std::size_t(n)].upper);
    }
    box = box.grown(margin, labels.grid);
    const Index3 lower = box.low;
    const Grid grid = cropped(labels.grid, box);
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

/// The stages; what one finds the later ones use.
class Automatic {
public:
    Automatic(const HuVolume& volume, Vector3 gravity, const SegmentOptions& options, Progress& progress)
        : volume_(volume), gravity_(gravity), options_(options), progress_(progress)
    {
    }

    Segmentation run()
    {
        progress_.report(0, "body");
        body_ = findBody(volume_, progress_);
        if (body_.empty())
            return organAbsent("there is no body in the scan");
        findGasAndFluid();
        progress_.report(0.5, "pieces");
        cutWhereAsked();
        findPieces();
        cutOffIlea();
        leaveOutDropped();
        rectum_ = findRectum(candidates_, body_, options_.catheter_radius_mm, progress_);
        if (rectum_ < 0)
            return organAbsent("there is no gas in the body that is wide enough for a rectum");
        progress_.report(0.8, "order of the pieces");
        orderThePieces();
        keepOrdered();
        refineWall();
        followCords(volume_, result_.inside, options_, result_.plan, progress_);
        judge();
        return std::move(result_);
    }

private:
    void findGasAndFluid()
    {
        progress_.report(0.1, "gas");
        const RunLabels gas = findGas(volume_, body_, options_.gas_below_hu);
        progress_.check();
        labels_ = labelGas(volume_, gas, componentsAt(gas, volume_.grid, options_.add));
        growToWall(volume_, options_.densities.wall_hu, labels_);
        progress_.report(0.3, "tagged fluid");
        const FluidDensities densities{options_.fluid_above_hu, options_.densities};
        fluid_ = addTaggedFluid(volume_, gravity_, densities, labels_, progress_);
        for (const Point3 p : options_.add)
            addFluidAt(volume_, p, densities, labels_);
    }

    void cutWhereAsked()
    {
        for (const Point3 p : options_.cut)
            around_cuts_.push_back(cutAcross(labels_, p, progress_));
    }

    /// Pools and loops that touch through a thin wall fall apart while the rim of their fluid is set aside.
    void findPieces()
    {
        rim_layers_ = rimLayers(labels_.grid, options_.leak_mm);
        markFluidRim(labels_, rim_layers_);
        lumen_ = labelLumen(labels_, Neighbours::faces);
        findAllCandidates();
    }

    void findAllCandidates()
    {
        added_ = componentsAt(lumen_, labels_.grid, options_.add);
        candidates_ =
            findCandidates(labels_, lumen_, body_, options_.smallest_piece_ml, kMostCandidates, added_, progress_);
    }

    void cutOffIlea()
    {
        ilea_ = cutIlea(labels_, candidates_, rim_layers_, options_.add, body_, progress_);
        if (std::none_of(ilea_.begin(), ilea_.end(), [](const IleumCut& ileum) { return ileum.cut; }))
            return;
        lumen_ = labelLumen(labels_, Neighbours::faces);
        findAllCandidates();
    }

    void leaveOutDropped()
    {
        std::set<int> dropped = separated(lumen_, around_cuts_);
        for (const int n : componentsAt(lumen_, labels_.grid, options_.drop))
            dropped.insert(n);
        std::erase_if(candidates_, [&](const Candidate& c) { return dropped.contains(int(c.label)); });
    }

    void orderThePieces()
    {
        std::vector<int> required;
        for (std::size_t n = 0; n < candidates_.size(); ++n)
            if (std::find(added_.begin(), added_.end(), int(candidates_[n].label)) != added_.end())
                required.push_back(int(n));
        const auto fat_mm = [&](Point3 from, Point3 to) {
            return fatBetween_mm(volume_, labels_, options_.densities, from, to, progress_);
        };
        ordering_ = orderPieces(candidates_, rectum_, required, body_, labels_, fat_mm, options_, progress_);
        for (const OrderedPiece& p : ordering_.pieces)
            result_.plan.pieces.push_back(pieceFor(candidates_[std::size_t(p.candidate)], p.reversed));
        result_.plan.bridges = ordering_.bridges;
        endBeforeIleum(ilea_, result_.plan.pieces.back());
    }

    void keepOrdered()
    {
        std::set<int> chosen;
        for (const OrderedPiece& p : ordering_.pieces)
            chosen.insert(int(candidates_[std::size_t(p.candidate)].label));
        piece_count_ = int(chosen.size());
        result_.inside = cropTo(labels_, lumen_, chosen, kMargin_voxels + rim_layers_);
        restoreFluidRim(result_.inside, rim_layers_);
    }

    void refineWall()
    {
        const auto [faintest, brightest] = fluidRange_hu();
        if (faintest < brightest - kSameFluid_hu)
            settleFluidWall(volume_, options_.densities, piece_count_, result_.inside);
        keepThinFolds(volume_, options_.densities, piece_count_, result_.inside);
    }

    void judge()
    {
        const auto [faintest, brightest] = fluidRange_hu();
        result_.measures["noise_hu"] = fluid_.noise_hu;
        result_.measures["fluid_levels"] = fluid_.levels.size();
        result_.measures["fluid_faintest_hu"] = faintest;
        result_.measures["fluid_brightest_hu"] = brightest;
        result_.measures["candidates"] = describe(candidates_, ordering_);
        judgeSegmentation(result_, options_, body_, lumenCut_mm2(volume_, result_.inside));
        describeIlea(ilea_, result_);
        for (const Point3 p : options_.add)
            if (componentsAt(lumen_, labels_.grid, {p}).empty())
                note(result_, "there is no gas or fluid at the added point " + textOf(p));
    }

    /// Densities of the faintest and the brightest level of fluid; 0 without any.
    std::pair<double, double> fluidRange_hu() const
    {
        if (fluid_.levels.empty())
            return {0, 0};
        const auto [faintest, brightest] =
            std::minmax_element(fluid_.levels.begin(), fluid_.levels.end(),
                                [](const FluidLevel& a, const FluidLevel& b) { return a.density_hu < b.density_hu; });
        return {faintest->density_hu, brightest->density_hu};
    }

    const HuVolume& volume_;
    Vector3 gravity_;
    const SegmentOptions& options_;
    Progress& progress_;
    Body body_;
    InsideVolume labels_;  ///< of the whole scan
    FluidResult fluid_;
    std::vector<std::vector<Index3>> around_cuts_;  ///< voxels of lumen beside each cut
    int rim_layers_ = 0;
    RunLabels lumen_;
    std::vector<int> added_;  ///< components of `lumen_` that a person added
    std::vector<Candidate> candidates_;
    std::vector<IleumCut> ilea_;
    int rectum_ = -1;  ///< number of its candidate
    Ordering ordering_;
    int piece_count_ = 0;
    Segmentation result_;
};

}  // namespace

Segmentation segmentAutomatically(const HuVolume& volume, Vector3 gravity, const SegmentOptions& options,
                                  Progress& progress)
{
    return Automatic(volume, gravity, options, progress).run();
}

}  // namespace vicon::steps
