#pragma once

#include <vector>

#include "course.h"
#include "random.h"
#include "relax.h"

namespace vicon::phantom {

/// Where gas rises to, the lumen is a little wider; where the colon bends or loops meet, it is narrower.
void shapeRadii(Course& course, Position position, Random& random);

/// Every position is distended in its own way; two differ by 0.75 to 1.35 at most, so that loops keep apart.
void distend(Course& course, const CourseOptions& options);

/// Lets no radius change faster along the curve than the colon's does.
void limitSlope(Course& course);

/// Narrows loops that lie too close together.
void narrowBetweenLoops(Course& course, double separation_mm, double least_wall_mm,
                        const std::vector<Contact>& contacts);

void smoothRadii(Course& course);

/// Widens both loops at each contact until just the wanted wall is left between them. False where that is too much.
bool closeContacts(Course& course, const std::vector<Contact>& contacts);

/// Whether a place became much narrower than the beads there are.
bool narrowed(const Course& course, const std::vector<Bead>& beads);

}  // namespace vicon::phantom
