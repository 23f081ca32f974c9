#pragma once

#include "tissue/stool.h"

namespace vicon::steps {

/// Moves to `left` the lumps that lie, no thicker than it, on a thin fold or septum: what blur mixes over so short a
/// way cannot be told apart.
void leaveOnThinFolds(const InsideVolume& inside, Stool& stool);

/// Moves to `wall` what stool would take of a wall between two sides of the lumen: where gas near a lump falls into
/// parts, the lump lies on the side of the largest, and before the others a wall is left.
void keepWallsBehind(const InsideVolume& inside, Stool& stool);

}  // namespace vicon::steps
