#include "loops.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vicon::phantom {

bool inContact(const std::vector<Contact>& contacts, double fraction_a, double fraction_b, double length_mm)
{
    constexpr double kReach = 40;
    return std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
        return std::abs(c.fraction_a - fraction_a) * length_mm < kReach &&
               std::abs(c.fraction_b - fraction_b) * length_mm < kReach;
    });
}

std::vector<Contact> closestLoops(const Course& course, const Relief& relief, int count, double wall_mm)
{
    const auto& s = course.samples;
    const double last = double(s.size() - 1);
    const auto nearPolyp = [&](double fraction) {
        return std::any_of(relief.polyps.begin(), relief.polyps.end(), [&](const PolypSite& polyp) {
            return std::abs(polyp.station_mm - fraction * relief.length_mm) < 38;
        });
    };
    std::vector<Contact> found;
    for (int n = 0; n < count; ++n) {
        std::optional<Contact> best;
        double least = 1e9;
        eachLoopPair(course, 3, [&](std::size_t a, std::size_t b, double apart) {
            const double slack = apart - s[a].radius_mm - s[b].radius_mm;
            const double fa = double(a) / last, fb = double(b) / last;
            const bool usable = slack < least && fa > 0.08 && fb < 0.95 && (fb - fa) * course.length_mm() > 130 &&
                                !nearPolyp(fa) && !nearPolyp(fb) &&
                                std::none_of(found.begin(), found.end(), [&](const Contact& c) {
                                    const auto near = [](double p, double q) { return std::abs(p - q) < 0.06; };
                                    return near(c.fraction_a, fa) || near(c.fraction_b, fb) || near(c.fraction_a, fb) ||
                                           near(c.fraction_b, fa);
                                });
            if (usable) {
                least = slack;
                best = Contact{fa, fb, wall_mm};
            }
        });
        if (best)
            found.push_back(*best);
    }
    return found;
}

bool plausible(const Course& course, const std::vector<Contact>& contacts, double separation_mm)
{
    const auto& s = course.samples;
    const double last = double(s.size() - 1), length_mm = course.length_mm();
    for (const CourseSample& sample : s)
        if (sample.radius_mm * sample.curvature >= 0.9 || sample.radius_mm < 8.5)
            return false;
    bool apart_enough = true;
    eachLoopPair(course, 2, [&](std::size_t a, std::size_t b, double apart) {
        if (!inContact(contacts, double(a) / last, double(b) / last, length_mm))
            apart_enough &= apart >= s[a].radius_mm + s[b].radius_mm + 0.8 * separation_mm;
    });
    return apart_enough;
}

double loopDistance_mm(double radius_a_mm, double radius_b_mm)
{
    return 2.1 * (radius_a_mm + radius_b_mm);
}

}  // namespace vicon::phantom
