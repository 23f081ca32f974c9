#include "segment/automatic.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "segment/body.h"
#include "segment/constants.h"
#include "segment/cut.h"
#include "segment/field_of_view.h"
#include "segment/fluid/fluid.h"
#include "segment/fluid/rim.h"
#include "segment/given/given_labels.h"
#include "segment/ileum/ileum_cut.h"
#include "segment/lumen.h"
#include "segment/pieces/bridge_way.h"
#include "segment/pieces/candidates.h"
#include "segment/pieces/chosen.h"
#include "segment/pieces/ordering.h"
#include "segment/points.h"
#include "segment/verdict.h"
#include "segment/wall/leaks.h"
#include "segment/wall/settle_wall.h"
#include "segment/wall/thin_folds.h"
#include "vicon/steps/noise.h"

namespace vicon::steps {
namespace {

// Held by chain_family_test. Half and double of each leave ctc-prone and phantom 215 as they are.
// Half-way densities of pools that differ by no more than this lie a tenth of a voxel apart.
constexpr double kSameFluid_hu = 60;
constexpr int kMostComponents = 10;  // largest first; beyond are specks of gas. Half and double: as above
constexpr double kSameEnd_mm = 15;   // between ends of the lumen: nearer, they are one
// A person says that it is the colon; the figures say that it cannot be one.
constexpr double kUnlikelyGiven = 0.3;

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
    if (result.plan.pieces.empty())
        return;
    const Point3 end = result.plan.pieces.back().caecal_end_mm;
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

/// The stages; what one finds the later ones use. A lumen that was given is neither cut nor trimmed: gas and fluid are
/// those of it, and all its pieces belong to the colon.
class Automatic {
public:
    Automatic(const HuVolume& volume, const InsideVolume* given, Vector3 gravity, const SegmentOptions& options,
              Progress& progress)
        : volume_(volume), given_(given), gravity_(gravity), options_(options), progress_(progress)
    {
    }

    Segmentation run()
    {
        progress_.report(0, "body");
        body_ = findBody(volume_, progress_);
        if (body_.empty())
            return organAbsent("there is no body in the scan");
        if (given_)
            takeGiven();
        else
            findGasAndFluid();
        progress_.report(0.5, "pieces");
        cutWhereAsked();
        findPieces();
        if (given_)
            findEndBeforeIleum();
        else
            cutOffIlea();
        if (!chooseAndJudge())
            return organAbsent(given_ ? "no piece of the given lumen is as large and wide as a rectum"
                                      : "there is no gas in the body that is wide enough for a rectum");
        if (!given_ && result_.confidence < 1)
            chooseWithoutLeaks();
        return std::move(result_);
    }

private:
    /// @return false where there is no rectum
    bool chooseAndJudge()
    {
        leaveOutDropped();
        rectum_ = findRectum(candidates_, body_, options_.catheter_radius_mm, progress_);
        if (rectum_ < 0)
            return false;
        progress_.report(0.8, "order of the pieces");
        orderThePieces();
        keepOrdered();
        if (!given_)
            refineWall();
        followCords(volume_, result_.inside, options_, result_.plan, progress_);
        judge();
        return true;
    }

    /// Loops with a thin wall between them may hang together by a hole alone, and a collapsed stretch is passed by.
    /// Only what is likelier to be a colon counts: a narrow passage looks like such a hole.
    void chooseWithoutLeaks()
    {
        progress_.report(0.9, "leaks");
        const std::vector<Point3> leaks = closeLeaks(volume_, options_.densities, labels_);
        if (leaks.empty())
            return;
        Segmentation with_leaks = std::exchange(result_, Segmentation());
        lumen_ = labelLumen(labels_, Neighbours::faces);
        findAllCandidates();
        if (!chooseAndJudge() || result_.confidence <= with_leaks.confidence) {
            result_ = std::move(with_leaks);
            return;
        }
        for (const Point3 leak : leaks)
            note(result_, "a hole in a thin wall was closed at " + textOf(leak));
    }

    void takeGiven()
    {
        progress_.report(0.1, "the given lumen");
        GivenLabels given = labelGiven(volume_, *given_, options_, progress_);
        labels_ = std::move(given.labels);
        result_.measures["given_dense_ml"] = given.dense_ml;
        fluid_.noise_hu = softTissueNoise(volume_);
        for (const Point3 p : options_.add)
            addGasAndFluidAt(volume_, body_, p, options_, labels_);
    }

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
        if (!given_) {
            rim_layers_ = rimLayers(labels_.grid, options_.leak_mm);
            markFluidRim(labels_, rim_layers_);
        }
        lumen_ = labelLumen(labels_, Neighbours::faces);
        findAllCandidates();
    }

    void findAllCandidates()
    {
        added_ = componentsAt(lumen_, labels_.grid, options_.add);
        FoundCandidates found = findCandidates(labels_, lumen_, body_, options_.smallest_piece_ml,
                                               given_ ? kMostCandidates : kMostComponents, added_, progress_);
        candidates_ = std::move(found.candidates);
        left_out_ = found.left_out;
    }

    void cutOffIlea()
    {
        ilea_ = cutIlea(labels_, candidates_, rim_layers_, options_.add, body_, progress_);
        if (std::none_of(ilea_.begin(), ilea_.end(), [](const IleumCut& ileum) { return ileum.cut; }))
            return;
        lumen_ = labelLumen(labels_, Neighbours::faces);
        findAllCandidates();
    }

    /// Of a given lumen nothing is cut off; only where the curve ends is sought.
    void findEndBeforeIleum()
    {
        InsideVolume as_given = labels_;
        ilea_ = cutIlea(labels_, candidates_, rim_layers_, options_.add, body_, progress_);
        labels_ = std::move(as_given);
        std::erase_if(ilea_, [](const IleumCut& ileum) { return ileum.cut; });
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
            if (given_ ? candidates_.size() > 1
                       : std::find(added_.begin(), added_.end(), int(candidates_[n].label)) != added_.end())
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
        if (!given_) {
            result_.measures["fluid_levels"] = fluid_.levels.size();
            result_.measures["fluid_faintest_hu"] = faintest;
            result_.measures["fluid_brightest_hu"] = brightest;
        }
        result_.measures["candidates"] = describe(candidates_, ordering_);
        if (given_)
            judgeGiven();
        else
            judgeSegmentation(result_, options_, body_, lumenCut_mm2(volume_, result_.inside));
        describeIlea(ilea_, result_);
        if (fluid_.runaway_ml > 0)
            note(result_,
                 std::to_string(std::lround(fluid_.runaway_ml)) +
                     " ml as dense as tagging ran out of the scan, as bone beside a pool does, and were cut off");
        for (const Point3 p : options_.add)
            if (componentsAt(lumen_, labels_.grid, {p}).empty())
                note(result_, "there is no gas or fluid at the added point " + textOf(p));
    }

    /// What is too little for a colon stays when a person gave it.
    void judgeGiven()
    {
        Segmentation judged;
        judged.plan = result_.plan;
        judgeSegmentation(judged, options_, body_, lumenCut_mm2(volume_, result_.inside));
        const bool unlikely = judged.verdict == Verdict::absent;
        result_.verdict = unlikely ? Verdict::unsure : judged.verdict;
        result_.confidence = unlikely ? kUnlikelyGiven : judged.confidence;
        result_.reason = "the lumen was given by a person";
        note(result_, judged.reason);
        if (left_out_ > 0)
            note(result_, "its " + std::to_string(left_out_) + " smallest pieces were left out: no more than " +
                              std::to_string(kMostCandidates) + " are put in order");
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
    const InsideVolume* given_;  ///< none: the lumen is sought
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
    int left_out_ = 0;  ///< components that are large enough, but too many
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
    return Automatic(volume, nullptr, gravity, options, progress).run();
}

Segmentation segmentGiven(const HuVolume& volume, const InsideVolume& given, Vector3 gravity,
                          const SegmentOptions& options, Progress& progress)
{
    return Automatic(volume, &given, gravity, options, progress).run();
}

}  // namespace vicon::steps
