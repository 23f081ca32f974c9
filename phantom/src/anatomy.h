#pragma once

#include <array>
#include <string>
#include <vector>

#include "random.h"
#include "vicon/core/geometry.h"

namespace vicon::phantom {

/// The patient's frame: x to the left, y to the back, z to the head, mm. z = 0 lies below the anus, x = y = 0 in the
/// middle of the trunk. Proportions of an adult of medium build.
inline constexpr double kFieldMm = 379;   ///< side of the reconstructed square
inline constexpr double kHeightMm = 430;  ///< scanned length

enum class Position { supine, prone, left, right };

/// A position as DICOM's PatientPosition names it.
struct Placement {
    Position position = Position::supine;
    bool feet_first = false;
};
/// Throws Error{wrong_use} on any other name.
Placement placementFrom(const std::string& patient_position);
/// Unit vector that points down to the table.
Vector3 gravityOf(Position position);

/// The ellipsoid, upright, that an organ fills.
struct Ellipsoid {
    Point3 centre_mm;
    Vector3 radii_mm;
};

/// A cross-section |x/a|^p + |(y-y0)/b|^p = 1.
struct Oval {
    double half_x_mm = 0, half_y_mm = 0, centre_y_mm = 0;
    double exponent = 2;
    /// Below 1 inside, 1 on the outline.
    double value(double x, double y) const;
};

/// What surrounds the colon and what it must keep out of.
struct Trunk {
    Oval skin(double z) const;
    /// The room for gut, within muscles and bones.
    Oval cavity(double z) const;
    /// Height of the diaphragm above (x, y).
    double diaphragm(double x, double y) const;

    double build = 1;          ///< scale of girth
    double flatten_front = 0;  ///< mm by which lying on the belly presses the front in
};

/// Organs that the colon goes around.
std::vector<Ellipsoid> obstacles();

/// A stop on the colon's way.
struct WayPoint {
    Point3 position_mm;
    double radius_mm;  ///< usual lumen
    double mobility;   ///< 0 fixed to the back wall, 1 on a long mesentery
};
/// The usual way from the rectum to the caecum.
std::vector<WayPoint> usualWay();
/// Places on the usual way, in stops.
struct WayMarks {
    double sigmoid = 3;            ///< the rectum leaves the sacrum's hollow
    double descending = 10.5;      ///< fixed to the back wall from half-way between 10 and 11
    double splenic_corner = 15.1;  ///< farthest up and to the left
    double hepatic_corner = 23.4;  ///< farthest up and to the right
    double caecum = 27.5;          ///< the wide end below
    double flexure_mm = 40;        ///< to either side of the corner
};

}  // namespace vicon::phantom
