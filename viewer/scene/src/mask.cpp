#include "mask.h"

#include <algorithm>
#include <cmath>

namespace vicon::viewer {
namespace {

// std::hypot guards against overflow, which pixels cannot reach, and takes several times as long.
double lengthOf(double x, double y)
{
    return std::sqrt(x * x + y * y);
}

}  // namespace

Mask::Mask(int width, int height)
    : width_(width),
      height_(height),
      x0_(width),
      y0_(height),
      x1_(0),
      y1_(0),
      cover_(std::size_t(width) * std::size_t(height))
{
}

void Mask::clear()
{
    for (int y = y0_; y < y1_; ++y)
        std::fill_n(cover_.begin() + std::ptrdiff_t(y) * width_ + x0_, x1_ - x0_, std::uint8_t(0));
    x0_ = width_;
    y0_ = height_;
    x1_ = y1_ = 0;
}

void Mask::add(int x, int y, int cover)
{
    if (x < 0 || y < 0 || x >= width_ || y >= height_ || cover <= 0)
        return;
    std::uint8_t& there = cover_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
    there = std::uint8_t(std::max(int(there), std::min(cover, 255)));
    x0_ = std::min(x0_, x);
    y0_ = std::min(y0_, y);
    x1_ = std::max(x1_, x + 1);
    y1_ = std::max(y1_, y + 1);
}

// Calls `cover` with the middle of each pixel of the box that lies in the picture.
template <class Cover>
void Mask::addShape(double x0, double y0, double x1, double y1, Cover cover)
{
    const auto inside = [](double v, int most) { return int(std::clamp(v, 0.0, double(most))); };
    const int left = inside(x0 - 1, width_), right = inside(x1 + 2, width_);
    const int top = inside(y0 - 1, height_), bottom = inside(y1 + 2, height_);
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
            add(x, y, int(std::lround(std::clamp(cover(x + 0.5, y + 0.5), 0.0, 1.0) * 255)));
}

void Mask::addSegment(Pixel a, Pixel b, double width_px)
{
    const double r = width_px / 2, dx = b.x - a.x, dy = b.y - a.y, l2 = dx * dx + dy * dy;
    addShape(std::min(a.x, b.x) - r, std::min(a.y, b.y) - r, std::max(a.x, b.x) + r, std::max(a.y, b.y) + r,
             [&](double x, double y) {
                 const double t = l2 > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / l2, 0.0, 1.0) : 0;
                 return r + 0.5 - lengthOf(x - a.x - t * dx, y - a.y - t * dy);
             });
}

void Mask::addBox(const Area& box, double edge_px)
{
    addShape(box.x - edge_px, box.y - edge_px, box.right() + edge_px, box.bottom() + edge_px, [&](double x, double y) {
        const double dx = std::max({box.x - x, x - box.right(), 0.0}),
                     dy = std::max({box.y - y, y - box.bottom(), 0.0});
        const double share = std::clamp(1 - lengthOf(dx, dy) / edge_px, 0.0, 1.0);
        return share * share * (3 - 2 * share);  // without a step where it begins and ends: no edge is seen
    });
}

void Mask::addRing(Pixel c, double inner_px, double outer_px)
{
    addShape(c.x - outer_px, c.y - outer_px, c.x + outer_px, c.y + outer_px, [&](double x, double y) {
        const double d = lengthOf(x - c.x, y - c.y);
        return std::min(outer_px + 0.5 - d, inner_px < 0 ? 1.0 : d - inner_px + 0.5);
    });
}

void Mask::blendInto(Picture& picture, Rgb color, double strength) const
{
    const double ink[3] = {double(color.red), double(color.green), double(color.blue)};
    for (int y = y0_; y < y1_; ++y)
        for (int x = x0_; x < x1_; ++x) {
            const std::size_t n = std::size_t(y) * std::size_t(width_) + std::size_t(x);
            if (cover_[n] == 0)
                continue;
            const double share = cover_[n] / 255.0 * strength;
            for (std::size_t c = 0; c < 3; ++c) {
                std::uint8_t& there = picture.rgb[3 * n + c];
                there = std::uint8_t(std::lround(there + (ink[c] - there) * share));
            }
        }
}

void Mask::growInto(Mask& out, double radius_px) const
{
    struct Near {
        int dx, dy;
        double weight;
    };
    std::vector<Near> near;
    const int reach = int(std::ceil(radius_px));
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx)
            if (const double weight = std::clamp(radius_px + 0.5 - lengthOf(dx, dy), 0.0, 1.0); weight > 0)
                near.push_back({dx, dy, weight});
    for (int y = y0_; y < y1_; ++y)
        for (int x = x0_; x < x1_; ++x)
            if (const int here = cover_[std::size_t(y) * std::size_t(width_) + std::size_t(x)]; here > 0)
                for (const Near& n : near)
                    out.add(x + n.dx, y + n.dy, int(here * n.weight));
}

}  // namespace vicon::viewer
