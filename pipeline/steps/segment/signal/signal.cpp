#include <vector>

#include "segment/as_is.h"
#include "segment/verdict.h"
#include "vicon/core/error.h"
#include "vicon/core/usual_densities.h"
#include "vicon/steps/lumen_contrast.h"

namespace vicon::steps {
namespace {

/// Nothing is told apart by less than this part of the tissue's signal.
constexpr double kLeastContrast = 0.2;

bool canBeTold(const SignalLevels& levels)
{
    const bool dark = levels.contrast == LumenContrast::dark;
    const double contrast = dark ? levels.tissue - levels.lumen : levels.lumen - levels.tissue;
    return levels.tissue > 0 && contrast > kLeastContrast * levels.tissue;
}

/// The segmentation speaks of what fills the lumen in CT.
std::string inWordsOfMr(std::string reason)
{
    for (const std::string of_ct : {"gas and fluid", "gas or fluid", "gas"})
        for (std::size_t at = reason.find(of_ct); at != std::string::npos; at = reason.find(of_ct))
            reason.replace(at, of_ct.size(), "lumen");
    return reason;
}

/// In the scan's own units; noise in per cent of the difference between lumen and tissue.
void tellLevels(const SignalLevels& levels, Segmentation& found)
{
    if (const auto noise = found.measures.find("noise_hu"); noise != found.measures.end()) {
        found.measures["noise_percent"] = 100 * noise->get<double>() / kUsualLumenToTissue_hu;
        found.measures.erase("noise_hu");
    }
    for (const char* of_fluid : {"fluid_levels", "fluid_faintest_hu", "fluid_brightest_hu"})
        found.measures.erase(of_fluid);
    found.measures["contrast"] = nameIn(kLumenContrastNames, levels.contrast);
    found.measures["lumen_signal"] = levels.lumen;
    found.measures["tissue_signal"] = levels.tissue;
    found.measures["threshold_signal"] = levels.halfway();
    found.reason = inWordsOfMr(std::move(found.reason));
    if (found.verdict != Verdict::absent)
        note(found, std::string("MR: the lumen is ") + nameIn(kLumenContrastNames, levels.contrast));
}

bool isBetter(const Segmentation& a, const Segmentation& b)
{
    if ((a.verdict == Verdict::absent) != (b.verdict == Verdict::absent))
        return b.verdict == Verdict::absent;
    return a.verdict != Verdict::absent && a.confidence > b.confidence;
}

std::vector<LumenContrast> contrastsToTry(LumenContrast wanted)
{
    if (wanted == LumenContrast::automatic)
        return {LumenContrast::dark, LumenContrast::bright};
    return {wanted};
}

/// Gas and tissue alone: nothing reaches the density of tagged fluid on the lumen's scale.
class ContrastTrial {
public:
    ContrastTrial(const HuVolume& evened, Vector3 gravity, const SegmentOptions& options, Progress& progress)
        : evened_(evened), gravity_(gravity), options_(options), progress_(progress)
    {
    }

    void tryLevels(const SignalLevels& levels, const std::optional<InsideVolume>& given)
    {
        if (!canBeTold(levels))
            return;
        SignalSegmentation one;
        one.lumen_scale = onLumenScale(evened_, levels);
        one.found = segmentAsIs(one.lumen_scale, given ? &*given : nullptr, gravity_, options_, progress_);
        SignalLevels told = levels;
        if (one.found.verdict != Verdict::absent)
            one.lumen_scale = onLumenScaleAround(evened_, one.lumen_scale, one.found.inside, told);
        tellLevels(told, one.found);
        if (!best_ || isBetter(one.found, best_->found))
            best_ = std::move(one);
    }

    /// Nothing better is to be expected of another contrast.
    bool isSure() const
    {
        constexpr double kSure = 0.8;  // confidence; no case recorded; lumen_contrast_test holds it on phantom seed 611
        return best_ && best_->found.verdict == Verdict::found && best_->found.confidence >= kSure;
    }

    SignalSegmentation best()
    {
        if (best_)
            return std::move(*best_);
        SignalSegmentation none;
        none.found = organAbsent(
            "nothing stands out from the tissue by its signal; set segment.contrast, "
            "segment.lumen_signal and segment.tissue_signal");
        return none;
    }

private:
    const HuVolume& evened_;
    Vector3 gravity_;
    const SegmentOptions& options_;
    Progress& progress_;
    std::optional<SignalSegmentation> best_;
};

}  // namespace

HuVolume onLumenScaleOf(const HuVolume& signal, const InsideVolume& lumen, const SignalOptions& options,
                        Progress& progress)
{
    const HuVolume evened = evenedOut(signal, shadingOf(signal, progress));
    const SignalLevels levels = levelsWithin(evened, lumen, options);
    if (!canBeTold(levels))
        throw Error(ErrorCode::bad_input, "gives the same signal as what is around it: no lumen", {},
                    "check the scan, and the mask's axes, left and right above all");
    return onLumenScale(evened, levels);
}

SignalSegmentation segmentSignal(const HuVolume& signal, const std::optional<InsideVolume>& given, Vector3 gravity,
                                 const SegmentOptions& options, const SignalOptions& signal_options, Progress& progress)
{
    progress.report(0, "shading");
    const HuVolume evened = evenedOut(signal, shadingOf(signal, progress));
    ContrastTrial trial(evened, gravity, options, progress);
    if (given)
        trial.tryLevels(levelsWithin(evened, *given, signal_options), given);
    else
        for (const LumenContrast contrast : contrastsToTry(signal_options.contrast))
            if (!trial.isSure())
                trial.tryLevels(levelsOf(evened, contrast, signal_options), given);
    return trial.best();
}

}  // namespace vicon::steps
