#pragma once

#include "vicon/core/volume_view.h"

namespace vicon::viewer {

/// Looks at each page of a mapped field that a camera in the lumen may ask for, on all cores: whoever asks later does
/// not wait for the disk. Fields of another grid are left alone.
void bringInLumen(const FieldView& field, const InsideView& inside);

}  // namespace vicon::viewer
