#pragma once

#include <string>

#include "vicon/core/geometry.h"

namespace vicon::viewer {

/// The letter of the patient's side towards which a direction points most: R, L, A, P, H or F.
char letterFor(Vector3 direction);

/// One or two letters, the stronger first: the second is given where its part is at least half of the first's.
std::string lettersFor(Vector3 direction);

/// The side a direction points to in words: "the head", "the feet", "the left", "the right", "the front", "the back".
std::string sideName(Vector3 direction);

/// The orthogonal planes, as radiologists look at them, and the one across the lumen.
enum class SlicePlane { axial, coronal, sagittal, across };

/// A plane's name for captions.
std::string nameOf(SlicePlane plane);

/// Directions of a slice's picture. Axial: seen from the feet, anterior up, the patient's right on the left.
/// Coronal: seen from the front, head up, the patient's right on the left. Sagittal: head up, anterior on the left.
/// They depend on the patient alone, never on how the scan's voxels are stored or how the patient lay. Across the lumen
/// they differ from place to place: axesAcross().
struct SliceAxes {
    Vector3 right, down;
};
/// @param plane an orthogonal one
SliceAxes axesOf(SlicePlane plane);

}  // namespace vicon::viewer
