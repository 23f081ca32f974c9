#pragma once

#include <optional>

#include "vicon/cases/marker.h"
#include "vicon/viewer/scene/snapshot.h"

namespace vicon::viewer {

/// A view that was saved with a marker, and the station of its eye, which is not the marker's.
struct SavedView {
    Pose pose;
    double station_mm = 0;
};

/// What is kept as the marker's view.
MarkerView viewOf(const SnapshotResult& place);

/// Nothing where there is none or it makes no sense.
std::optional<SavedView> savedView(const Marker& marker);

}  // namespace vicon::viewer
