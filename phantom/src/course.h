#pragma once

#include <cstdint>
#include <vector>

#include "anatomy.h"
#include "folds.h"
#include "posture_warp.h"
#include "vicon/core/geometry.h"

namespace vicon::phantom {

/// The axis of the colon as a smooth curve, sampled evenly.
struct CourseSample {
    Point3 position_mm;
    Vector3 tangent;       ///< towards the caecum
    Vector3 normal;        ///< of a frame that does not turn about the tangent
    Vector3 binormal;      ///< tangent x normal
    Vector3 bend;          ///< towards the inside of the bend, as long as the curvature per mm
    double curvature = 0;  ///< per mm
    double radius_mm = 0;  ///< of the lumen without folds, the largest over the angle
    double mobility = 0;
};

/// Samples lie `step_mm` (about 1 mm) apart along the curve.
struct Course {
    std::vector<CourseSample> samples;
    double step_mm = 1;
    double length_mm() const { return step_mm * double(samples.size() - 1); }
    double stationOf(std::size_t n) const { return step_mm * double(n); }
    std::size_t sampleAt(double station_mm) const;
};

/// Two stations of loops that are pulled together until this much wall is left between their lumens.
struct Contact {
    double fraction_a = 0, fraction_b = 0;
    double wall_mm = 0;  ///< below 0: the lumens run into one another
};

struct CourseOptions {
    std::uint64_t seed = 1;
    Position position = Position::supine;
    double separation_mm = 5;  ///< least distance between the lumens of two loops
    int thin_walls = 0;        ///< places with little wall between two loops
    double thin_wall_mm = 1.5;
    bool self_contact = false;
    double thinnest_fold_mm = 2;
    int polyps = 5;
    bool stretch = false;  ///< the wall lies otherwise along the course in every position
};

struct DrawnCourse {
    Course course;
    Relief relief;  ///< stretched to the course
    Trunk trunk;
    std::vector<Contact> contacts;
    PostureWarp warp;                     ///< from the patient's own colon to stations of the course
    std::vector<double> stop_station_mm;  ///< where the stops of usualWay() lie on the course
};

/// Draws the way of this patient's colon in this position: the usual way, varied, grown to a length of 1.5 to 1.9 m on
/// its mesentery and relaxed until loops, walls and organs keep apart. Redraws until radius x curvature < 0.9
/// everywhere and loops keep their distance.
DrawnCourse drawCourse(const CourseOptions& options);

/// Two stations count as different loops when they lie further apart along the curve than this.
double loopDistance_mm(double radius_a_mm, double radius_b_mm);

}  // namespace vicon::phantom
