#pragma once

#include "vicon/cases/case_store.h"
#include "vicon/core/options.h"

namespace vicon::app {

/// Asks the modality worklist of orders.peer for the orders of new cases until VICON is told to stop, and tells of it
/// in the log. Returns at once where no peer is configured.
void askForOrdersInBackground(const StorePlace& place, const Config& config);

}  // namespace vicon::app
