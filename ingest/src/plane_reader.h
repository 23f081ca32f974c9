#pragma once

#include <set>
#include <string>
#include <vector>

#include "dataset.h"
#include "image_object.h"
#include "vicon/core/quantity.h"

namespace vicon::ingest {

/// The planes of an object: of a plain CT image its one, of a multi-frame object all its frames.
/// `why` says what is missing or wrong when there are none.
struct Planes {
    std::vector<Slice> slices;
    std::string why;
    /// There is no position or orientation at all: what screen saves and dose sheets look like.
    bool without_geometry = false;
    /// What had to be assumed.
    std::set<std::string> repairs;
};
Planes readPlanes(const Dataset& dataset, int frames, Quantity quantity);

}  // namespace vicon::ingest
