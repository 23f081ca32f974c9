#include "vicon/viewer/model/slice_image.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vicon::viewer {
namespace {

struct Sampler {
    const HuView* volume;
    std::size_t stride_j, stride_k;

    explicit Sampler(const HuView& v)
        : volume(&v), stride_j(std::size_t(v.grid.size[0])), stride_k(stride_j * std::size_t(v.grid.size[1]))
    {
    }

    float operator()(ContinuousIndex3 c) const
    {
        const auto& n = volume->grid.size;
        constexpr double kHalf = 0.5;  // a voxel reaches half its size beyond its middle
        if (c.i < -kHalf || c.j < -kHalf || c.k < -kHalf || c.i > n[0] - kHalf || c.j > n[1] - kHalf ||
            c.k > n[2] - kHalf)
            return kPaddingHu;
        const double x = std::clamp(c.i, 0.0, n[0] - 1.0), y = std::clamp(c.j, 0.0, n[1] - 1.0),
                     z = std::clamp(c.k, 0.0, n[2] - 1.0);
        const std::size_t i = std::size_t(x), j = std::size_t(y), k = std::size_t(z);
        const std::size_t di = i + 1 < std::size_t(n[0]) ? 1 : 0, dj = j + 1 < std::size_t(n[1]) ? stride_j : 0,
                          dk = k + 1 < std::size_t(n[2]) ? stride_k : 0;
        const std::int16_t* v = volume->voxels.data() + i + stride_j * j + stride_k * k;
        const double a = x - double(i), b = y - double(j), d = z - double(k);
        const auto row = [&](const std::int16_t* r) { return r[0] + a * (r[di] - r[0]); };
        const double near = row(v) + b * (row(v + dj) - row(v));
        const double far = row(v + dk) + b * (row(v + dj + dk) - row(v + dk));
        return float(near + d * (far - near));
    }
};

double along(Vector3 direction, const Bounds& bounds)
{
    const Vector3 size = bounds.upper_mm - bounds.lower_mm;
    return std::abs(direction.x) * size.x + std::abs(direction.y) * size.y + std::abs(direction.z) * size.z;
}

}  // namespace

std::vector<float> sliceDensities(const HuView& volume, const PlaneView& view, const Progress* wanted)
{
    const Sampler sample(volume);
    const auto at = [&](double x, double y) { return volume.grid.continuousIndexAt(view.pointAt({x, y})); };
    const ContinuousIndex3 first = at(0.5, 0.5), beside = at(1.5, 0.5);
    const ContinuousIndex3 step{beside.i - first.i, beside.j - first.j, beside.k - first.k};
    std::vector<float> densities(std::size_t(view.width) * std::size_t(view.height));
    auto* out = densities.data();
    for (int y = 0; y < view.height; ++y) {
        if (wanted)
            wanted->check();
        const ContinuousIndex3 c = at(0.5, y + 0.5);
        for (int x = 0; x < view.width; ++x)
            *out++ = sample({c.i + step.i * x, c.j + step.j * x, c.k + step.k * x});
    }
    return densities;
}

std::vector<float> sliceDensities(const HuView& volume, const HuView& cleansed, const PlaneView& view,
                                  const Progress* wanted)
{
    std::vector<float> densities = sliceDensities(volume, view, wanted);
    const std::vector<float> clean = sliceDensities(cleansed, view, wanted);
    for (std::size_t n = 0; n < densities.size(); ++n)
        if (clean[n] != kPaddingHu)
            densities[n] = clean[n];
    return densities;
}

Bounds boundsOf(const Grid& grid)
{
    const auto corner = [&](int n) {
        return grid.pointAt(ContinuousIndex3{n & 1 ? grid.size[0] - 0.5 : -0.5, n & 2 ? grid.size[1] - 0.5 : -0.5,
                                             n & 4 ? grid.size[2] - 0.5 : -0.5});
    };
    Bounds bounds{corner(0), corner(0)};
    for (int n = 1; n < 8; ++n) {
        const Point3 p = corner(n);
        auto &l = bounds.lower_mm, &u = bounds.upper_mm;
        l = {std::min(l.x, p.x), std::min(l.y, p.y), std::min(l.z, p.z)};
        u = {std::max(u.x, p.x), std::max(u.y, p.y), std::max(u.z, p.z)};
    }
    return bounds;
}

PlaneView sliceThrough(const Grid& grid, SlicePlane plane, Point3 point, int width, int height, double field_mm)
{
    return sliceThrough(grid, axesOf(plane), point, width, height, field_mm);
}

PlaneView sliceThrough(const Grid& grid, const SliceAxes& axes, Point3 point, int width, int height, double field_mm)
{
    const Bounds bounds = boundsOf(grid);
    PlaneView view{point, axes.right, axes.down, 1, width, height};
    if (field_mm > 0) {
        view.mm_per_pixel = field_mm / std::min(width, height);
        return view;
    }
    const Vector3 normal = view.forward();
    const Point3 middle = bounds.centre_mm();
    view.centre_mm = middle + normal * dot(point - middle, normal);
    view.mm_per_pixel = std::max(along(axes.right, bounds) / width, along(axes.down, bounds) / height);
    return view;
}

PlaneView pixelForPixel(const Grid& grid, const PlaneView& view, Point3 point, int voxels_a_pixel)
{
    PlaneView exact = view;
    exact.mm_per_pixel = std::numeric_limits<double>::max();
    constexpr double kAcross = 0.7;  // of an axis that is more across the plane than in it
    for (std::size_t a = 0; a < 3; ++a)
        if (std::abs(dot(grid.axis[a], view.forward())) < kAcross)
            exact.mm_per_pixel = std::min(exact.mm_per_pixel, grid.spacing_mm[a]);
    const double to_middle = (voxels_a_pixel - 1) / 2.0 * exact.mm_per_pixel;  // of the pixel's voxels
    exact.mm_per_pixel *= voxels_a_pixel;
    // Pixels' middles lie at halves, also where the picture's middle is an edge between two of them.
    const int column = view.width / 2, row = view.height / 2;
    const double x = column + 0.5 - view.width / 2.0, y = row + 0.5 - view.height / 2.0;
    exact.centre_mm = grid.pointAt(grid.indexAt(point)) + (view.right + view.down) * to_middle -
                      (view.right * x + view.down * y) * exact.mm_per_pixel;
    return exact;
}

}  // namespace vicon::viewer
