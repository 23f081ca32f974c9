#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "scan_fixture.h"
#include "vicon/picture/png_file.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/snapshot.h"

namespace vicon::viewer::test {

inline Picture readPng(const std::filesystem::path& file)
{
    const picture::Picture read = picture::readPng(file);
    Picture picture(read.width, read.height);
    picture.rgb = read.pixels;
    return picture;
}

/// Pixels of a colour.
struct Found {
    int count = 0;
    double x = 0, y = 0;  // middle of their pixels
};

/// Pixels of this colour within an area.
inline Found findColor(const Picture& picture, Rgb color, const Area& area, int tolerance = 0)
{
    const auto near = [&](Rgb c) {
        return std::abs(c.red - color.red) <= tolerance && std::abs(c.green - color.green) <= tolerance &&
               std::abs(c.blue - color.blue) <= tolerance;
    };
    Found found;
    for (int y = int(area.y); y < int(area.bottom()); ++y)
        for (int x = int(area.x); x < int(area.right()); ++x)
            if (near(picture.at(x, y))) {
                ++found.count;
                found.x += x;
                found.y += y;
            }
    found.x /= std::max(1, found.count);
    found.y /= std::max(1, found.count);
    return found;
}

/// The part of all values that differ by more than the tolerance.
inline double differing(const Picture& a, const Picture& b, int tolerance)
{
    std::size_t count = 0;
    for (std::size_t n = 0; n < a.rgb.size(); ++n)
        count += std::abs(int(a.rgb[n]) - int(b.rgb[n])) > tolerance;
    return double(count) / double(a.rgb.size());
}

inline Marker markerAt(Point3 p, MarkerColor color, const std::string& id)
{
    Marker marker;
    marker.id = id;
    marker.position_mm = p;
    marker.color = color;
    return marker;
}

/// A fixture whose scans are drawn into a file and read from it.
template <class Fixture>
struct Shooting : Fixture {
    Picture shoot(const PreparedScan& of, const SnapshotRequest& request, SnapshotResult* result = nullptr) const
    {
        const auto file = this->folder / "picture.png";
        const SnapshotResult r = renderSnapshot(of, request, file);
        if (result)
            *result = r;
        return readPng(file);
    }
};

}  // namespace vicon::viewer::test
