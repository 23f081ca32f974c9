#include "vicon/viewer/model/plane_size.h"

#include <algorithm>
#include <cmath>

namespace vicon::viewer {
namespace {

constexpr double kLeast_mm = 1, kMost_mm = 80;
constexpr int kPlanesToASide = 8;     // 7.5 degrees between them
constexpr double kMostLean_deg = 60;  // from upright: a plane that grazes the wall cuts it, not the finding
constexpr double kAroundEnd_mm = 2;   // where the wall's normal is looked for; the next loop may lie 1.6 mm off
constexpr double kSureNormal = 0.2;   // of the sum of two unit vectors
constexpr double kRayStep_mm = 0.2;   // less than a third of a voxel of clinical CT
constexpr double kMostSteps = 100;    // along the line
constexpr double kHeights = 3, kSpare_mm = 8;  // a polyp on a stalk is higher than wide
constexpr double kMostAir = 0.2;               // of a diameter: the ends lie within a voxel or two of the border
constexpr double kLarger = 1.02;               // of two planes that show as much the more upright one is taken

/// How much of the place is lumen, 0 to 1, trilinear between voxels.
double lumenAt(const InsideView& inside, Point3 p)
{
    const ContinuousIndex3 c = inside.grid.continuousIndexAt(p);
    const double i0 = std::floor(c.i), j0 = std::floor(c.j), k0 = std::floor(c.k);
    const double x = c.i - i0, y = c.j - j0, z = c.k - k0;
    double share = 0;
    for (int n = 0; n < 8; ++n) {
        const Index3 v{int(i0) + (n & 1), int(j0) + (n >> 1 & 1), int(k0) + (n >> 2)};
        if (inside.valueOr(v, std::uint8_t(kOutside)) != kOutside)
            share += (n & 1 ? x : 1 - x) * (n & 2 ? y : 1 - y) * (n & 4 ? z : 1 - z);
    }
    return share;
}

/// Where the lumen lies around a point of the wall, as a unit vector; zero where it is nowhere or everywhere.
Vector3 lumenSide(const InsideView& inside, Point3 p)
{
    constexpr int kSteps = 4;
    Vector3 sum{0, 0, 0};
    for (int z = -kSteps; z <= kSteps; ++z)
        for (int y = -kSteps; y <= kSteps; ++y)
            for (int x = -kSteps; x <= kSteps; ++x) {
                const Vector3 d = Vector3{double(x), double(y), double(z)} * (kAroundEnd_mm / kSteps);
                if (length(d) <= kAroundEnd_mm)
                    sum = sum + d * lumenAt(inside, p + d);
            }
    return length(sum) > 1e-6 ? normalized(sum) : Vector3{0, 0, 0};
}

/// Away from the wall on which a line stands that joins two points of it: the sides of the finding, to which they
/// belong as well, face away from one another. Towards the eye where the two say nothing.
Vector3 uprightFor(const InsideView& inside, Point3 a, Point3 b, Vector3 along, Vector3 to_eye)
{
    const Vector3 both = lumenSide(inside, a) + lumenSide(inside, b);
    const Vector3 across = both - along * dot(both, along);
    return uprightOn(along, length(across) > kSureNormal && dot(across, to_eye) > 0 ? across : to_eye);
}

struct Flat {
    double u = 0, v = 0;
};

double turnOf(Flat o, Flat a, Flat b)
{
    return (a.u - o.u) * (b.v - o.v) - (a.v - o.v) * (b.u - o.u);
}

/// Points in order of u, then v, come out as the corners of their hull.
std::vector<Flat> hullOf(const std::vector<Flat>& points)
{
    std::vector<Flat> hull;
    const auto add = [&](Flat p, std::size_t keep) {
        while (hull.size() >= keep + 2 && turnOf(hull[hull.size() - 2], hull.back(), p) <= 0)
            hull.pop_back();
        hull.push_back(p);
    };
    for (const Flat& p : points)
        add(p, 0);
    const std::size_t lower = hull.size() - 1;
    for (auto p = points.rbegin() + 1; p != points.rend(); ++p)
        add(*p, lower);
    return hull;
}

/// What stands above a line in one plane: u along the line from its first point, v up from it.
class CrossSection {
public:
    CrossSection(const InsideView& inside, Point3 origin, Vector3 along, Vector3 up, double length_mm)
        : length_mm_(length_mm),
          step_(std::max(kRayStep_mm, length_mm / kMostSteps)),
          line_(int(length_mm / step_) + 1),
          width_(3 * line_),
          height_(int((kHeights * length_mm + kSpare_mm) / step_) + 1)
    {
        tissue_.resize(std::size_t(width_) * std::size_t(height_));
        lowest_lumen_.assign(std::size_t(width_), height_);
        for (int v = 0; v < height_; ++v)
            for (int u = 0; u < width_; ++u) {
                const bool lumen = lumenAt(inside, origin + along * uOf(u) + up * (v * step_)) > 0.5;
                tissue_[at(u, v)] = !lumen;
                if (lumen)
                    lowest_lumen_[std::size_t(u)] = std::min(lowest_lumen_[std::size_t(u)], v);
            }
        grow();
    }

    bool bounded() const { return bounded_; }
    double area_mm2() const { return double(pixels_) * step_ * step_; }

    /// Whether a line runs through what stands there, and not through the lumen beside it.
    bool inTissue(Flat a, Flat b) const
    {
        const int steps = std::max(1, int(std::hypot(a.u - b.u, a.v - b.v) / step_));
        int air = 0;
        for (int n = 0; n <= steps; ++n) {
            const double t = double(n) / steps;
            const int u = int(std::lround(std::lerp(a.u, b.u, t) / step_)) + line_;
            const int v = int(std::lround(std::lerp(a.v, b.v, t) / step_));
            air += u < 0 || u >= width_ || v < 0 || v >= height_ || !tissue_[at(u, v)] ? 1 : 0;
        }
        return air <= kMostAir * (steps + 1);
    }

    /// The two points that lie farthest apart, with tissue between them.
    std::pair<Flat, Flat> diameter() const
    {
        std::pair<Flat, Flat> farthest{{0, 0}, {length_mm_, 0}};
        if (edge_.empty())
            return farthest;
        const std::vector<Flat> hull = hullOf(edge_);
        double most = length_mm_;
        for (const Flat& a : hull)
            for (const Flat& b : hull)
                if (const double d = std::hypot(a.u - b.u, a.v - b.v); d > most + step_ && inTissue(a, b)) {
                    most = d;
                    farthest = {a, b};
                }
        return farthest;
    }

private:
    double uOf(int u) const { return (u - line_) * step_; }
    std::size_t at(int u, int v) const { return std::size_t(v) * std::size_t(width_) + std::size_t(u); }
    bool overLine(int u) const { return u >= line_ && uOf(u) <= length_mm_; }

    /// From the line upwards; beyond its ends only over lumen.
    void grow()
    {
        std::vector<std::uint8_t> taken(tissue_.size());
        std::vector<std::pair<int, int>> todo;
        const auto take = [&](int u, int v) {
            if (u < 0 || v < 0 || u >= width_ || v >= height_ || !tissue_[at(u, v)] || taken[at(u, v)])
                return;
            if (!overLine(u) && lowest_lumen_[std::size_t(u)] > v)
                return;
            taken[at(u, v)] = 1;
            todo.emplace_back(u, v);
        };
        for (int u = line_; overLine(u); ++u)
            take(u, 0);
        while (!todo.empty()) {
            const auto [u, v] = todo.back();
            todo.pop_back();
            ++pixels_;
            bounded_ = bounded_ && u > 0 && u + 1 < width_ && v + 1 < height_;
            take(u + 1, v);
            take(u - 1, v);
            take(u, v + 1);
            take(u, v - 1);
        }
        for (int u = 0; u < width_; ++u) {  // a column's lowest and highest are all that a hull needs
            int low = -1, high = -1;
            for (int v = 0; v < height_; ++v)
                if (taken[at(u, v)]) {
                    low = low < 0 ? v : low;
                    high = v;
                }
            if (low >= 0)
                edge_.push_back({uOf(u), low * step_});
            if (high > low)
                edge_.push_back({uOf(u), high * step_});
        }
    }

    double length_mm_, step_;
    int line_, width_, height_;
    std::vector<std::uint8_t> tissue_;
    std::vector<int> lowest_lumen_;  // by column
    std::vector<Flat> edge_;
    std::size_t pixels_ = 0;
    bool bounded_ = true;
};

}  // namespace

std::optional<PlaneSize> sizeOnBestPlane(const InsideView& inside, Point3 a, Point3 b, Point3 eye,
                                         const Progress* wanted)
{
    const double length_mm = distance(a, b);
    if (!(length_mm >= kLeast_mm && length_mm <= kMost_mm))
        return std::nullopt;
    PlaneSize best;
    best.middle_mm = interpolate(a, b, 0.5);
    best.along = (b - a) / length_mm;
    const Vector3 up = uprightFor(inside, a, b, best.along, eye - best.middle_mm), aside = cross(best.along, up);
    for (int n = 0; n <= 2 * kPlanesToASide; ++n) {  // from upright, to one side and the other
        if (wanted)
            wanted->check();
        const int lean = n % 2 == 0 ? n / 2 : -(n + 1) / 2;
        const double angle = radians(kMostLean_deg * lean / kPlanesToASide);
        const Vector3 turned = up * std::cos(angle) + aside * std::sin(angle);
        const CrossSection section(inside, a, best.along, turned, length_mm);
        if (n == 0 && !section.bounded())
            return std::nullopt;  // a leaning plane would cut through what has no end here
        if (!section.bounded() || section.area_mm2() <= kLarger * best.area_mm2)
            continue;
        const auto [from, to] = section.diameter();
        if (!section.inTissue(from, to))
            continue;  // the clicked line runs through the lumen: its ends are not those of one finding
        best.area_mm2 = section.area_mm2();
        best.up = turned;
        best.from_mm = a + best.along * from.u + turned * from.v;
        best.to_mm = a + best.along * to.u + turned * to.v;
        best.diameter_mm = distance(best.from_mm, best.to_mm);
    }
    if (best.area_mm2 <= 0)
        return std::nullopt;
    return best;
}

PlaneView viewOf(const PlaneSize& size, int width, int height, double field_mm)
{
    return {size.middle_mm, size.along, -size.up, field_mm / std::min(width, height), width, height};
}

}  // namespace vicon::viewer
