#pragma once

#include "vicon/core/geometry.h"

namespace vicon::viewer {

/// `v` turned about the axis `turn` by its length in radians (Rodrigues' formula).
Vector3 rotated(Vector3 v, Vector3 turn);

/// The turn that takes one pair of orthogonal unit vectors to another, at most half a circle; about `up_a` where it is
/// exactly half a circle with no axis of its own.
Vector3 rotationBetween(Vector3 forward_a, Vector3 up_a, Vector3 forward_b, Vector3 up_b);

}  // namespace vicon::viewer
