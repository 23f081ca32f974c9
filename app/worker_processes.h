#pragma once

#include "command.h"

namespace vicon::app {

/// Runs so many 'vicon work' on the store, each a process of its own, until all of them end or this one is told to
/// stop. A worker that ends before that is replaced, later each time that its successor does not last; with
/// `until_idle` one that was killed alone: the others end by themselves. Returns the exit code: that of the worst of
/// them.
int runWorkers(Context& context, int count, bool until_idle);

}  // namespace vicon::app
