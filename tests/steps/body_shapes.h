#pragma once

// Parts of a body without a colon, as densities in HU of a point in LPS mm. All lie within 144 x 100 mm, and go from
// z = -90 to 90 mm.

#include <algorithm>
#include <cmath>

#include "segment_shapes.h"

namespace vicon::steps::test {

/// Signed distance to an ellipsoid, about right near it.
inline double ellipsoid(Point3 p, Point3 centre, Vector3 radii)
{
    const Vector3 d = p - centre;
    const double r =
        std::sqrt(d.x * d.x / (radii.x * radii.x) + d.y * d.y / (radii.y * radii.y) + d.z * d.z / (radii.z * radii.z));
    return (r - 1) * std::min({radii.x, radii.y, radii.z});
}

/// A body's cross-section of soft tissue in air.
inline double trunkHu(Point3 p)
{
    return -1000 + 1040 * blurred((1 - std::hypot(p.x / 72, p.y / 50)) * 50, 0.7);
}

/// Two lungs with vessels, a trachea; they leave the scan at its upper end.
inline double chestHu(Point3 p)
{
    double hu = trunkHu(p);
    for (const double side : {-1.0, 1.0}) {
        const double lung_mm = ellipsoid(p, {side * 34, 0, 60}, {26, 38, 110});
        const double vessels = std::sin(p.x / 3) * std::sin(p.y / 4) * std::sin(p.z / 5) > 0.6 ? 300 : 0;
        hu += (-870 + vessels - hu) * (1 - blurred(lung_mm, 0.7));
    }
    const double trachea_mm = tubeDistance({{0, -5, 20}, {0, -5, 120}}, 8, p);
    return hu + (-1000 - hu) * (1 - blurred(trachea_mm, 0.7));
}

/// A skull with air in its sinuses and ears.
inline double headHu(Point3 p)
{
    double hu = trunkHu(p);
    const double skull_mm = std::abs(ellipsoid(p, {0, 0, 20}, {58, 40, 60})) - 3;
    hu += (1100 - hu) * (1 - blurred(skull_mm, 0.7));
    double air_mm = 1e9;
    for (const double side : {-1.0, 1.0}) {
        air_mm = std::min(air_mm, ellipsoid(p, {side * 18, -28, -25}, {10, 7, 13}));
        air_mm = std::min(air_mm, tubeDistance({{side * 50, 5, -10}, {side * 64, 5, -12}}, 3.5, p));
    }
    air_mm = std::min(air_mm, tubeDistance({{0, -34, -20}, {0, -15, -30}, {0, -8, -89}}, 6, p));
    return hu + (-1000 - hu) * (1 - blurred(air_mm, 0.7));
}

/// A neck: pharynx and windpipe from end to end of the scan, and the spine.
inline double neckHu(Point3 p)
{
    double hu = -1000 + 1040 * blurred(50 - std::hypot(p.x, p.y), 0.7);
    hu += (500 - hu) * (1 - blurred(std::hypot(p.x, p.y - 20) - 14, 0.7));
    const double air_mm = tubeDistance({{0, -18, -120}, {0, -15, 20}, {0, -10, 120}}, 8, p);
    return hu + (-1000 - hu) * (1 - blurred(air_mm, 0.7));
}

/// Two legs beside each other, air between them.
inline double kneesHu(Point3 p)
{
    double hu = -1000;
    for (const double side : {-1.0, 1.0}) {
        const double from_axis_mm = std::hypot(p.x - side * 38, p.y);
        hu += (40 - hu) * (1 - blurred(from_axis_mm - 33, 0.7));
        hu += (700 - hu) * (1 - blurred(from_axis_mm - 14 - (std::abs(p.z) > 12 ? 0 : 4), 0.7));
    }
    return hu;
}

/// A cylinder of water with rods, as scanners are tested with.
inline double waterHu(Point3 p)
{
    double hu = -1000 + 1000 * blurred(50 - std::hypot(p.x, p.y), 0.7);
    for (const double side : {-1.0, 1.0})
        hu += (side * 900 - hu) * (1 - blurred(std::hypot(p.x - side * 25, p.y) - 6, 0.7));
    return hu;
}

/// Nobody lies in the scanner.
inline double emptyHu(Point3)
{
    return -1000;
}

}  // namespace vicon::steps::test
