#pragma once

#include "vicon/core/options.h"
#include "vicon/viewer/qt/reading_room.h"

namespace vicon::app {

/// What the reading room needs of the other rooms, on a store. `config` must outlive it.
viewer::ReadingServices readingServices(const StorePlace& store, const Config& config);

}  // namespace vicon::app
