#pragma once

#include <vector>

#include "course.h"
#include "vicon/phantom/phantom.h"
#include "wall.h"

namespace vicon::phantom {

/// Draws lumps of stool on any side of the wall, away from polyps, gaps and the rectal tube, each narrow enough to
/// leave a way for gas. Fewer where there is no room for them.
std::vector<StoolLump> drawStool(const PhantomOptions& options, const Course& course, const Wall& wall,
                                 Position position);

/// Gives every polyp a film of tagging, or none.
std::vector<TaggingFilm> drawFilms(const PhantomOptions& options, const Wall& wall, Position position);

/// Distance to a lump's surface, mm, below 0 inside.
double distanceTo(const StoolLump& lump, Point3 p);

/// Distance to the nearest bubble of air in a lump, mm, below 0 inside; large where there is none.
double distanceToBubble(const StoolLump& lump, Point3 p);

}  // namespace vicon::phantom
