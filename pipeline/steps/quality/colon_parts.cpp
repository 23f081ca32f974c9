#include "vicon/steps/colon_parts.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vicon::steps {
namespace {

// Lengths and angles below were chosen on phantom seeds 1 to 12, supine, and hold for the usual anatomy (rectum of 12
// to 15 cm above the anal canal, caecum of about 6 cm).
constexpr double kStep_mm = 5;        // of the centreline, between the points that are looked at
constexpr double kSmoothing_mm = 15;  // folds, haustra and the curve's wriggles are shorter
constexpr double kFlexureReach_mm = 40;
constexpr double kRectumAtLeast_mm = 60, kRectumAtMost_mm = 150;
constexpr double kCaecum_mm = 60;
constexpr double kTurnedAway = 0.78;  // cosine of 39 degrees
constexpr double kShortest_mm = 700, kFlexuresApart_mm = 60;

/// The curve, smoothed and sampled evenly.
struct Course {
    std::vector<Point3> points;
    double step_mm = kStep_mm;
    double stationOf(std::size_t n) const { return step_mm * double(n); }
    std::size_t sampleAt(double station_mm) const
    {
        return std::size_t(std::clamp(station_mm / step_mm, 0.0, double(points.size() - 1)));
    }
    /// How straight the course runs towards the head, -1 to 1, over 40 mm.
    double headward(std::size_t n) const
    {
        const std::size_t reach = std::size_t(20 / step_mm);
        const Vector3 along = points[std::min(n + reach, points.size() - 1)] - points[n > reach ? n - reach : 0];
        return normalized(along).z;
    }
};

Course smoothCourse(const Skeleton& skeleton)
{
    Course course;
    const auto count = std::max<std::size_t>(2, std::size_t(skeleton.length_mm() / kStep_mm) + 1);
    course.step_mm = skeleton.length_mm() / double(count - 1);
    std::vector<Point3> plain;
    for (std::size_t n = 0; n < count; ++n)
        plain.push_back(skeleton.at(course.stationOf(n)).position_mm);
    const int reach = int(3 * kSmoothing_mm / course.step_mm);
    for (int n = 0; n < int(count); ++n) {
        const int most = std::min({reach, n, int(count) - 1 - n});  // symmetric, so the ends stay
        Vector3 sum;
        double weights = 0;
        for (int m = n - most; m <= n + most; ++m) {
            const double d = (m - n) * course.step_mm / kSmoothing_mm, weight = std::exp(-0.5 * d * d);
            sum += (plain[std::size_t(m)] - Point3{}) * weight;
            weights += weight;
        }
        course.points.push_back(Point3{} + sum / weights);
    }
    return course;
}

struct Flexures {
    std::size_t splenic = 0, hepatic = 0;
    double missed_mm = 0;  ///< how much farther up and out the course reaches somewhere else
};

/// The pair in order whose heights and distances to the left and to the right add up to most.
Flexures findFlexures(const Course& course)
{
    const auto upperLeft = [&](std::size_t n) { return course.points[n].z + course.points[n].x; };
    const auto upperRight = [&](std::size_t n) { return course.points[n].z - course.points[n].x; };
    Flexures best;
    std::size_t splenic = 0;
    double most = -1e300, most_left = -1e300, most_right = -1e300;
    for (std::size_t n = 1; n < course.points.size(); ++n) {
        if (upperLeft(n - 1) > upperLeft(splenic))
            splenic = n - 1;
        if (upperLeft(splenic) + upperRight(n) > most) {
            most = upperLeft(splenic) + upperRight(n);
            best = {splenic, n};
        }
        most_left = std::max(most_left, upperLeft(n));
        most_right = std::max(most_right, upperRight(n));
    }
    best.missed_mm = std::max(most_left - upperLeft(best.splenic), most_right - upperRight(best.hepatic));
    return best;
}

double endOfRectum(const Course& course, std::size_t splenic)
{
    const std::size_t first = course.sampleAt(kRectumAtLeast_mm);
    const std::size_t last = std::min(course.sampleAt(kRectumAtMost_mm), splenic);
    for (std::size_t n = first; n < last; ++n)
        if (course.headward(n) < kTurnedAway)
            return course.stationOf(n);
    return course.stationOf(last);
}

double beginOfDescending(const Course& course, std::size_t rectum_end, std::size_t splenic)
{
    double lowest = course.points[splenic].z;
    for (std::size_t n = 0; n < splenic; ++n)
        lowest = std::min(lowest, course.points[n].z);
    const double half = (lowest + course.points[splenic].z) / 2;
    for (std::size_t n = splenic; n-- > rectum_end + 1;)
        if (course.points[n].z < half && course.headward(n) < kTurnedAway)
            return course.stationOf(n);
    return course.stationOf(rectum_end + 1);
}

}  // namespace

FoundParts findColonParts(const Skeleton& skeleton)
{
    if (skeleton.empty())
        return {{}, "there is no skeleton"};
    const double length_mm = skeleton.length_mm();
    if (length_mm < kShortest_mm)
        return {{}, "the skeleton is too short for a whole colon"};
    const Course course = smoothCourse(skeleton);
    const Flexures flexures = findFlexures(course);
    const Point3 splenic = course.points[flexures.splenic], hepatic = course.points[flexures.hepatic];
    if (splenic.x - hepatic.x < kFlexuresApart_mm || flexures.missed_mm > kFlexureReach_mm)
        return {{}, "no splenic flexure on the left before a hepatic flexure on the right"};

    const double rectum_to = endOfRectum(course, flexures.splenic);
    const double at_splenic = course.stationOf(flexures.splenic), at_hepatic = course.stationOf(flexures.hepatic);
    const double descending_from = beginOfDescending(course, course.sampleAt(rectum_to), flexures.splenic);
    const double caecum_from = length_mm + skeleton.at(length_mm).radius_mm - kCaecum_mm;
    const std::vector<double> bounds{0,
                                     rectum_to,
                                     descending_from,
                                     at_splenic - kFlexureReach_mm,
                                     at_splenic + kFlexureReach_mm,
                                     at_hepatic - kFlexureReach_mm,
                                     at_hepatic + kFlexureReach_mm,
                                     caecum_from,
                                     length_mm};
    for (std::size_t n = 0; n + 1 < bounds.size(); ++n)
        if (bounds[n + 1] <= bounds[n])
            return {{}, "the segments of the colon do not lie in the usual order"};
    FoundParts found;
    for (std::size_t n = 0; n + 1 < bounds.size(); ++n)
        found.ranges.push_back({ColonPart(n), bounds[n], bounds[n + 1]});
    return found;
}

}  // namespace vicon::steps
