#pragma once

#include "mask/image_header.h"
#include "mask/labelled_slices.h"
#include "vicon/core/progress.h"

namespace vicon::ingest {

/// Reads the voxels of an image file as labels. Throws Error{bad_input} when the file has not as many as its header
/// says, or they are no labels: fractions, negative, too many.
LabelledSlices readImageLabels(const ImageHeader& header, Progress& progress);

}  // namespace vicon::ingest
