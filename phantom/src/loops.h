#pragma once

#include <vector>

#include "course.h"

namespace vicon::phantom {

/// Whether two places, as fractions of the length, lie at one of the contacts.
bool inContact(const std::vector<Contact>& contacts, double fraction_a, double fraction_b, double length_mm);

/// Calls `visit(a, b, distance)` for samples of different loops, every `stride`-th sample.
void eachLoopPair(const Course& course, std::size_t stride, auto&& visit)
{
    const auto& s = course.samples;
    for (std::size_t a = 0; a < s.size(); a += stride)
        for (std::size_t b = a + stride; b < s.size(); b += stride) {
            const double along = course.step_mm * double(b - a);
            const Vector3 apart = s[b].position_mm - s[a].position_mm;
            if (dot(apart, apart) < 90 * 90 && along >= loopDistance_mm(s[a].radius_mm, s[b].radius_mm))
                visit(a, b, length(apart));
        }
}

/// The places where loops come closest, far from one another.
std::vector<Contact> closestLoops(const Course& course, const Relief& relief, int count, double wall_mm);

/// Whether no bend is too sharp for its radius, none too narrow, and loops keep apart but at contacts.
bool plausible(const Course& course, const std::vector<Contact>& contacts, double separation_mm);

}  // namespace vicon::phantom
