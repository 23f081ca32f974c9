#pragma once

#include "vicon/core/geometry.h"

namespace vicon::steps {

/// Of a voxel along axis 0, 1 or 2: its i, j or k.
inline int& coordinate(Index3& v, int axis)
{
    return axis == 0 ? v.i : axis == 1 ? v.j : v.k;
}
inline int coordinate(const Index3& v, int axis)
{
    return axis == 0 ? v.i : axis == 1 ? v.j : v.k;
}

/// The voxel that many steps along the axis.
inline Index3 beside(Index3 v, int axis, int steps)
{
    coordinate(v, axis) += steps;
    return v;
}

}  // namespace vicon::steps
