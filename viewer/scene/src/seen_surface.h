#pragma once

#include <optional>
#include <vector>

#include "vicon/core/cell_surface.h"
#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

/// The cells of a scan's surface that may be seen from some places.
struct SeenSurface {
    CellSurface cells;
    std::vector<float> openness;  ///< of its points, see opennessOf()
    struct From {
        Pose pose;
        Lens lens;
        std::vector<int> segments;  ///< of the cells that may be seen; empty: all
    };
    std::vector<From> places;

    /// Nothing for a place that is none of these.
    const From* from(const Pose& pose, const Lens& lens) const
    {
        for (const From& place : places)
            if (place.pose == pose && place.lens == lens)
                return &place;
        return nullptr;
    }
};

}  // namespace vicon::viewer
