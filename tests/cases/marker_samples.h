#pragma once

#include "vicon/cases/marker.h"

namespace vicon::test {

/// A marker that carries all that VICON knows.
inline Marker markerWithEverything()
{
    Marker m{.id = "m1", .scan_id = "s1", .position_mm = {1.5, -2, 3}, .color = MarkerColor::yellow};
    m.part = ColonPart::splenic_flexure;
    m.partners = {"m2"};
    m.size = {.straight_mm = 6.5, .along_mm = 8, .from_mm = {1, 2, 3}, .to_mm = {4, 5, 6}};
    m.size->plane = PlaneSize{7, {1, 2, 3}, {4, 5, 6}, 20, {2, 3, 4}, {1, 0, 0}, {0, 1, 0}};
    m.density = DensitySample{{1, 2, 3}, 4, 2, 31, 41.5, 18.25, 0.125, -25, {1, 30}};
    m.view = MarkerView{{9, 8, 7}, {0, 0, 1}, {0, 1, 0}, 412.5};
    return m;
}

}  // namespace vicon::test
