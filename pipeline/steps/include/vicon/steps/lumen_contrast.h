#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "vicon/core/option_names.h"
#include "vicon/core/options.h"
#include "vicon/core/progress.h"
#include "vicon/core/volume.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {

/// How the lumen stands out in a signal that has no unit (MR colonography): dark, filled with gas or with water on T1,
/// or bright, filled with water on T2 or with a contrast medium on T1.
enum class LumenContrast { automatic, dark, bright };
inline constexpr EnumNames<LumenContrast, 3> kLumenContrastNames{{
    {LumenContrast::automatic, "auto"},
    {LumenContrast::dark, "dark"},
    {LumenContrast::bright, "bright"},
}};
constexpr const auto& optionNames(LumenContrast /*value*/)
{
    return kLumenContrastNames;
}

struct SignalOptions {
    LumenContrast contrast = LumenContrast::automatic;
    double lumen_signal = 0;
    double tissue_signal = 0;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("segment.contrast", contrast, "",
          "MR: whether the lumen is dark or bright; auto: as a colon is found, dark first.", choicesOf(contrast));
        v("segment.lumen_signal", lumen_signal, "a.u.", "MR: the signal of what fills the lumen; 0: found in the scan.",
          {0, 32767});
        v("segment.tissue_signal", tissue_signal, "a.u.", "MR: the signal of the wall; 0: found in the scan.",
          {0, 32767});
    }
};

/// The signal of the lumen and of what is around it, in one scan whose shading was evened out.
struct SignalLevels {
    LumenContrast contrast = LumenContrast::dark;  ///< never automatic
    double lumen = 0;
    double tissue = 0;
    double air_below = 0;  ///< below it lies what gives no signal

    double halfway() const { return (lumen + tissue) / 2; }
};

/// The smooth shading of a signal by the receiving coils, 1 in the mean over the body; on a coarse grid over the
/// signal's. Method: N4 (N. J. Tustison et al., IEEE Transactions on Medical Imaging 29, 2010) as ITK has it.
/// Throws Error{cancelled}, Error{no_memory}.
FieldVolume shadingOf(const HuVolume& signal, Progress& progress);

/// The signal divided by its shading. Padding stays.
HuVolume evenedOut(HuVolume signal, const FieldVolume& shading);

/// The levels for a lumen that is dark or bright, from the classes that Otsu's method parts: no signal, tissue, and
/// what is brighter. Options that are set come first.
/// @param signal evened out
SignalLevels levelsOf(const HuVolume& signal, LumenContrast contrast, const SignalOptions& options);

/// The levels as a given lumen tells them: the medians well within it and around it.
/// @param lumen 1 in the lumen, on any lattice in LPS mm
SignalLevels levelsWithin(const HuVolume& signal, const InsideVolume& lumen, const SignalOptions& options);

/// The signal on the scale on which a lumen is found and its wall placed: what fills the lumen is -1000, tissue 40, as
/// gas and tissue are in CT, half-way in between. Not densities, and never shown as such. What is brighter than tissue
/// (a dark lumen) or darker (a bright one) is 40 to 110; the air around the body is -1000.
/// @param signal evened out
HuVolume onLumenScale(const HuVolume& signal, const SignalLevels& levels);

/// The same by a given lumen: shading, levels and scale. Throws Error{bad_input} where its signal is that of what is
/// around it, Error{cancelled}.
HuVolume onLumenScaleOf(const HuVolume& signal, const InsideVolume& lumen, const SignalOptions& options,
                        Progress& progress);

/// The same around a lumen that was found. Away from it stands what `scaled` has, at least 40; at its rim the wall's
/// own level counts, which is the brightest within three voxels of a dark lumen: fat beyond the wall may be as faint as
/// half of it.
/// @param scaled onLumenScale() by `levels`, which become those that were found
HuVolume onLumenScaleAround(const HuVolume& signal, const HuVolume& scaled, const InsideVolume& lumen,
                            SignalLevels& levels);

/// What was found of a scan of signal.
struct SignalSegmentation {
    Segmentation found;    ///< its measures tell of the levels too
    HuVolume lumen_scale;  ///< see onLumenScaleAround()
};

/// segmentColon() or, with `given`, segmentGivenColon() in a signal. Where the contrast is not known, both are tried
/// and the better result is taken. There is no tagged fluid: all of the lumen is kGas. Throws as those do.
SignalSegmentation segmentSignal(const HuVolume& signal, const std::optional<InsideVolume>& given, Vector3 gravity,
                                 const SegmentOptions& options, const SignalOptions& signal_options,
                                 Progress& progress);

}  // namespace vicon::steps
