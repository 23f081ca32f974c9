#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "vicon/core/cell_surface.h"

namespace vicon::viewer {

/// A corner of a triangle in a flat picture: pixels as of Pixel, and what lies behind what.
struct FlatCorner {
    float x = 0, y = 0, depth = 0;
};

/// Where a triangle lies in a flat picture.
struct FlatTriangle {
    std::uint32_t triangle = 0;
    std::array<FlatCorner, 3> corners;
};

/// Which triangle each pixel of a flat picture shows: the one of least depth at the pixel's middle, of equal ones the
/// first. Needs no display, and is the same on any number of cores.
class TriangleRaster {
public:
    TriangleRaster(int width, int height);

    /// What a pixel shows.
    struct Hit {
        std::uint32_t triangle = 0;
        std::array<double, 3> weights{};  ///< of its corners; together 1
    };

    /// Adds the triangles of a thing of that number, any number of them.
    using Place = std::function<void(std::size_t number, std::vector<FlatTriangle>& out)>;
    /// Draws once; a raster is made anew for another picture.
    /// @param place called for each number below `count`, on any thread
    void draw(std::size_t count, const Place& place);

    int width() const { return width_; }
    int height() const { return height_; }
    std::optional<Hit> at(int x, int y) const;

private:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    bool mayShow(const FlatTriangle& t) const;
    void fill();
    void fillRows(int first, int end);
    void fillTriangle(std::uint32_t number, int first, int end);

    int width_, height_;
    std::vector<FlatTriangle> placed_;
    std::vector<std::uint32_t> shown_;  // of each pixel, a number of placed_
    std::vector<float> depth_;
};

/// The point of a surface that is shown.
Point3 pointOf(const CellSurface& surface, const TriangleRaster::Hit& hit);

}  // namespace vicon::viewer
