#pragma once

#include "vicon/core/options.h"
#include "vicon/ingest/delivery.h"

namespace vicon::app {

/// How this configuration delivers what is in the outbox.
ingest::Delivery deliveryFor(const Config& config);

/// Delivers in the background, over a store connection of its own, until told to stop. Whatever goes wrong is said and
/// tried again.
void deliverInBackground(const StorePlace& place, const Config& config);

}  // namespace vicon::app
