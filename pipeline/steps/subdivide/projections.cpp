#include "vicon/steps/projections.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

// Of how the pictures look.
/// Pixels are computed this many times finer in both directions and averaged.
constexpr int kFiner = 2;
/// Free border around the surface.
constexpr double kBorder_mm = 10;
/// Brightness of a surface seen edge-on and face-on, and how much the farthest part is darkened.
constexpr double kEdgeOn = 0.25, kFaceOn = 1.0, kFarShade = 0.55;
/// Colour of the brightest surface: the warm grey of bowel wall.
constexpr std::array<double, 3> kColour{236, 214, 196};

struct View {
    const char* name;
    Vector3 right, down;  ///< LPS directions of growing column and row; the viewer looks along right x down
};

// Definitions.
constexpr std::array<View, 3> kViews{
    View{"coronal", {1, 0, 0}, {0, 0, -1}},    // from the front: the patient's left (+x) on the right
    View{"transverse", {1, 0, 0}, {0, 1, 0}},  // from the feet: front (-y) up, left (+x) on the right
    View{"sagittal", {0, 1, 0}, {0, 0, -1}},   // from the patient's left: front (-y) on the left
};

/// Depth and brightness at kFiner times the picture's resolution.
struct Raster {
    int width, height;
    std::vector<float> depth;  ///< mm along the view; the largest float where nothing is
    std::vector<float> shade;  ///< |cosine| between the surface's normal and the view

    Raster(int w, int h)
        : width(w),
          height(h),
          depth(std::size_t(w) * std::size_t(h), std::numeric_limits<float>::max()),
          shade(depth.size(), 0)
    {
    }
};

struct Corner {
    double x, y, depth, facing;
};

void fillTriangle(Raster& raster, const std::array<Corner, 3>& c)
{
    const double area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
    if (area == 0)
        return;
    const auto [x0, x1] = std::minmax({c[0].x, c[1].x, c[2].x});
    const auto [y0, y1] = std::minmax({c[0].y, c[1].y, c[2].y});
    const int left = std::max(0, int(std::ceil(x0))), right = std::min(raster.width - 1, int(std::floor(x1)));
    const int top = std::max(0, int(std::ceil(y0))), bottom = std::min(raster.height - 1, int(std::floor(y1)));
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) {
            const double a = ((c[1].x - x) * (c[2].y - y) - (c[2].x - x) * (c[1].y - y)) / area;
            const double b = ((c[2].x - x) * (c[0].y - y) - (c[0].x - x) * (c[2].y - y)) / area;
            if (a < 0 || b < 0 || a + b > 1)
                continue;
            const auto depth = float(a * c[0].depth + b * c[1].depth + (1 - a - b) * c[2].depth);
            const std::size_t n = std::size_t(y) * std::size_t(raster.width) + std::size_t(x);
            if (depth >= raster.depth[n])
                continue;
            raster.depth[n] = depth;
            raster.shade[n] = float(std::abs(a * c[0].facing + b * c[1].facing + (1 - a - b) * c[2].facing));
        }
}

struct Box {
    Point3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
};

Box boxOf(const CellSurface& surface)
{
    Box box;
    for (std::size_t n = 0; n < surface.pointCount(); ++n) {
        const Point3 p = surface.point(n);
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
    return box;
}

/// The picture's place: the box of the surface with its border, from its corner of least column and row.
Projection frameFor(const View& view, const Box& box, double pixel_mm)
{
    const auto cornerAlong = [](Vector3 direction, Point3 low, Point3 high, bool first) {
        const Vector3 from = (direction.x + direction.y + direction.z > 0) == first ? low - Point3{} : high - Point3{};
        return dot(from, direction) + (first ? -kBorder_mm : kBorder_mm);
    };
    const double left = cornerAlong(view.right, box.low, box.high, true);
    const double top = cornerAlong(view.down, box.low, box.high, true);
    Projection picture;
    picture.name = view.name;
    picture.pixel_mm = pixel_mm;
    picture.right = view.right;
    picture.down = view.down;
    picture.first_pixel_mm = Point3{} + view.right * left + view.down * top;
    picture.width = int(std::ceil((cornerAlong(view.right, box.low, box.high, false) - left) / pixel_mm)) + 1;
    picture.height = int(std::ceil((cornerAlong(view.down, box.low, box.high, false) - top) / pixel_mm)) + 1;
    return picture;
}

Raster rasterize(const CellSurface& surface, const Projection& picture)
{
    Raster raster(picture.width * kFiner, picture.height * kFiner);
    const Vector3 ahead = cross(picture.right, picture.down);
    std::vector<Corner> corners(surface.pointCount());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, corners.size(), 4096), [&](const auto& range) {
        for (std::size_t n = range.begin(); n < range.end(); ++n) {
            const Point3 p = surface.point(n);
            const Vector3 normal{surface.normals[3 * n], surface.normals[3 * n + 1], surface.normals[3 * n + 2]};
            // The middle of a fine pixel (0,0) lies (kFiner - 1)/2 fine pixels before the middle of pixel (0,0).
            corners[n] = {picture.column(p) * kFiner + 0.5 * (kFiner - 1), picture.row(p) * kFiner + 0.5 * (kFiner - 1),
                          dot(p - picture.first_pixel_mm, ahead), dot(normal, ahead)};
        }
    });
    for (std::size_t t = 0; t < surface.triangleCount(); ++t) {
        const std::uint32_t* c = &surface.triangles[3 * t];
        fillTriangle(raster, {corners[c[0]], corners[c[1]], corners[c[2]]});
    }
    return raster;
}

void shade(Projection& picture, const Raster& raster)
{
    float nearest = std::numeric_limits<float>::max(), farthest = -nearest;
    for (const float depth : raster.depth)
        if (depth < std::numeric_limits<float>::max()) {
            nearest = std::min(nearest, depth);
            farthest = std::max(farthest, depth);
        }
    picture.rgba.assign(std::size_t(picture.width) * std::size_t(picture.height) * 4, 0);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            double sum = 0;
            int covered = 0;
            for (int n = 0; n < kFiner * kFiner; ++n) {
                const std::size_t f = std::size_t(y * kFiner + n / kFiner) * std::size_t(raster.width) +
                                      std::size_t(x * kFiner + n % kFiner);
                if (raster.depth[f] == std::numeric_limits<float>::max())
                    continue;
                const double far = (raster.depth[f] - nearest) / std::max(1e-6F, farthest - nearest);
                sum += std::lerp(kEdgeOn, kFaceOn, double(raster.shade[f])) * (1 - kFarShade * far);
                ++covered;
            }
            if (covered == 0)
                continue;
            auto* pixel = &picture.rgba[4 * (std::size_t(y) * std::size_t(picture.width) + std::size_t(x))];
            for (std::size_t c = 0; c < 3; ++c)
                pixel[c] = std::uint8_t(std::lround(std::min(255.0, kColour[c] * sum / covered)));
            pixel[3] = std::uint8_t(255 * covered / (kFiner * kFiner));
        }
}

}  // namespace

std::array<Projection, 3> project(const CellSurface& surface, const ProjectionOptions& options, Progress& progress)
{
    if (surface.triangleCount() == 0)
        throw Error(ErrorCode::bad_input, "the surface has no triangles to project");
    progress.report(0, "projections");
    const Box box = boxOf(surface);
    std::array<Projection, 3> pictures;
    tbb::parallel_for(std::size_t(0), kViews.size(), [&](std::size_t n) {
        pictures[n] = frameFor(kViews[n], box, options.pixel_mm);
        shade(pictures[n], rasterize(surface, pictures[n]));
    });
    progress.check();
    progress.report(1, "projections");
    return pictures;
}

}  // namespace vicon::steps
