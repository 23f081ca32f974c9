#pragma once

#include "stack_plan.h"
#include "vicon/core/progress.h"
#include "vicon/core/volume.h"

namespace vicon::ingest {

/// Decodes the slices of a stack, in parallel, into the volume that `plan` describes.
/// Throws Error{bad_input} naming the file that cannot be decoded, Error{no_memory}, Error{cancelled}.
HuVolume readVolume(const Stack& stack, const StackPlan& plan, Progress& progress);

/// Tells whether two images hold the same stored pixels; not, when one cannot be decoded. It keeps the objects that it
/// compared last open. Not for several threads at once. Throws Error{cancelled}.
SamePixels comparePixels(Progress& progress);

}  // namespace vicon::ingest
