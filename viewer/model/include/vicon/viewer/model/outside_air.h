#pragma once

#include "vicon/core/volume_view.h"

namespace vicon::viewer {

/// What a place that a reader takes for lumen may be.
enum class LumenGuess {
    possible,     ///< gas or tagged fluid lies within 4 mm
    tissue,       ///< neither does
    outside_body  ///< the gas there is air that reaches the edge of its slice, as stored; or the scan ends before it
};

/// What is certainly no lumen is told apart at once; what is, only the pipeline can say. Looks at one slice.
LumenGuess guessLumen(const HuView& volume, Point3 point);

}  // namespace vicon::viewer
