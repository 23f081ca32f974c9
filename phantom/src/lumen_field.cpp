#include "lumen_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace vicon::phantom {
namespace {

constexpr double kBand_mm = 5;  // evaluated beyond the outside of the wall

/// A piece of the curve between two of its normal planes; at an end also the half-space beyond the plane.
struct Stretch {
    std::size_t n = 0;  // from sample n to n + 1
    int beyond = 0;     // -1: before the rectal end, +1: behind the caecal end
    Point3 centre_mm;
    double reach_mm = 0;
    std::uint8_t pool = LumenField::kNoPool;
    std::vector<const Polyp*> polyps;
};

/// A plane's value (distance along its normal) as a linear function of the column within a row of voxels.
struct Linear {
    double at0 = 0, slope = 0;
    double operator()(int i) const { return at0 + slope * i; }
};

Linear planeAlongRow(const CourseSample& sample, Point3 row_start, Vector3 column_step)
{
    return {dot(sample.tangent, row_start - sample.position_mm), dot(sample.tangent, column_step)};
}

/// Columns where the linear function may be at least zero, cut from [from, to].
void keepPositive(Linear f, int& from, int& to)
{
    if (f.slope > 1e-12)
        from = std::max(from, int(std::clamp(std::floor(-f.at0 / f.slope), -1e9, 1e9)));
    else if (f.slope < -1e-12)
        to = std::min(to, int(std::clamp(std::ceil(-f.at0 / f.slope), -1e9, 1e9)));
    else if (f.at0 < -1e-6)
        to = from - 1;
}

class Rasteriser {
public:
    Rasteriser(const Grid& grid, const Course& course, const Wall& wall, const std::vector<FluidPool>& pools)
        : grid_(grid), course_(course), wall_(wall)
    {
        const std::size_t last = course.samples.size() - 1;
        for (std::size_t n = 0; n < last; ++n)
            addStretch(n, 0, pools);
        addStretch(0, -1, pools);
        addStretch(last - 1, 1, pools);
        frameBox();
    }

    LumenField field;

    void slice(int k)
    {
        for (const Stretch& stretch : stretches_) {
            const ContinuousIndex3 c = grid_.continuousIndexAt(stretch.centre_mm);
            const double height_mm = (c.k - k) * grid_.spacing_mm[2];
            const double half_mm = stretch.reach_mm * stretch.reach_mm - height_mm * height_mm;
            if (half_mm > 0)
                disc(stretch, c, k, std::sqrt(half_mm));
        }
    }

private:
    void addStretch(std::size_t n, int beyond, const std::vector<FluidPool>& pools)
    {
        Stretch s;
        s.n = n;
        s.beyond = beyond;
        const CourseSample &a = course_.samples[n], &b = course_.samples[n + 1];
        s.centre_mm = beyond < 0   ? a.position_mm
                      : beyond > 0 ? b.position_mm
                                   : interpolate(a.position_mm, b.position_mm, 0.5);
        const double station_mm = course_.stationOf(n);
        s.reach_mm =
            std::max(wall_.largestOutside_mm(station_mm), wall_.largestOutside_mm(station_mm + course_.step_mm)) +
            kBand_mm + course_.step_mm;
        for (std::size_t p = 0; p < pools.size(); ++p)
            if (station_mm + course_.step_mm / 2 >= pools[p].from_mm &&
                station_mm + course_.step_mm / 2 <= pools[p].to_mm)
                s.pool = std::uint8_t(p);
        for (const Polyp& polyp : wall_.polyps)
            if (std::abs(polyp.station_mm - station_mm) < 20)
                s.polyps.push_back(&polyp);
        stretches_.push_back(std::move(s));
    }

    void frameBox()
    {
        std::array<double, 3> low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
        for (const Stretch& s : stretches_) {
            const ContinuousIndex3 c = grid_.continuousIndexAt(s.centre_mm);
            const double at[3] = {c.i, c.j, c.k};
            for (std::size_t a = 0; a < 3; ++a) {
                low[a] = std::min(low[a], at[a] - s.reach_mm / grid_.spacing_mm[a]);
                high[a] = std::max(high[a], at[a] + s.reach_mm / grid_.spacing_mm[a]);
            }
        }
        field.cropped = false;
        int first[3];
        for (std::size_t a = 0; a < 3; ++a) {
            first[a] = std::clamp(int(std::floor(low[a])), 0, grid_.size[a]);
            field.cropped = field.cropped || low[a] < 0 || high[a] > grid_.size[a] - 1;
            field.size[a] = std::max(0, std::clamp(int(std::ceil(high[a])) + 1, 0, grid_.size[a]) - first[a]);
        }
        field.low = {first[0], first[1], first[2]};
        const std::size_t count = std::size_t(field.size[0]) * std::size_t(field.size[1]) * std::size_t(field.size[2]);
        field.lumen.assign(count, LumenField::kFar);
        field.outside.assign(count, LumenField::kFar);
        field.pool.assign(count, LumenField::kNoPool);
    }

    void disc(const Stretch& stretch, ContinuousIndex3 c, int k, double radius_mm)
    {
        const double rows = radius_mm / grid_.spacing_mm[1];
        const int first = std::max(field.low.j, int(std::ceil(c.j - rows)));
        const int last = std::min(field.low.j + field.size[1] - 1, int(std::floor(c.j + rows)));
        for (int j = first; j <= last; ++j) {
            const double dy = (c.j - j) * grid_.spacing_mm[1];
            const double columns = std::sqrt(std::max(0.0, radius_mm * radius_mm - dy * dy)) / grid_.spacing_mm[0];
            const int from = std::max(field.low.i, int(std::ceil(c.i - columns)));
            const int to = std::min(field.low.i + field.size[0] - 1, int(std::floor(c.i + columns)));
            if (from <= to)
                row(stretch, from, to, j, k);
        }
    }

    void row(const Stretch& stretch, int from, int to, int j, int k)
    {
        const Point3 start = grid_.pointAt(Index3{0, j, k});
        const Vector3 step = grid_.axis[0] * grid_.spacing_mm[0];
        const Linear past = planeAlongRow(course_.samples[stretch.n], start, step);
        const Linear before = planeAlongRow(course_.samples[stretch.n + 1], start, step);
        if (stretch.beyond >= 0)
            keepPositive(stretch.beyond > 0 ? before : past, from, to);
        if (stretch.beyond <= 0) {
            const Linear& limit = stretch.beyond < 0 ? past : before;
            keepPositive({-limit.at0, -limit.slope}, from, to);
        }
        for (int i = from; i <= to; ++i) {
            const double a = past(i), b = before(i);
            const bool here = stretch.beyond < 0 ? a < 0 : stretch.beyond > 0 ? b >= 0 : a >= 0 && b < 0;
            if (here)
                voxel(stretch, start + step * i, a, b, field.offset({i, j, k}));
        }
    }

    void voxel(const Stretch& stretch, Point3 p, double a, double b, std::size_t offset)
    {
        const CourseSample &s0 = course_.samples[stretch.n], &s1 = course_.samples[stretch.n + 1];
        const double t = stretch.beyond < 0 ? 0 : stretch.beyond > 0 ? 1 : a / (a - b);
        const Vector3 d = p - interpolate(s0.position_mm, s1.position_mm, t);
        const double away_mm = length(d);
        const Vector3 n = s0.normal * (1 - t) + s1.normal * t, m = s0.binormal * (1 - t) + s1.binormal * t;
        const Wall::Sample wall =
            wall_.at(course_.stationOf(stretch.n) + t * course_.step_mm, std::atan2(dot(d, m), dot(d, n)));
        // Planes of a bent curve lie closer together on its inner side.
        const double crowding = stretch.beyond != 0 ? 1 : std::max(0.1, (a - b) / course_.step_mm);
        const double along = stretch.beyond != 0 ? 0 : wall.lumen_per_station / crowding;
        const double around = wall.lumen_per_radian / std::max(away_mm, 1.0);
        double lumen_mm = (away_mm - wall.lumen_mm) / std::sqrt(1 + along * along + around * around);
        // Beside a fold the slope says that the wall is near even where the fold's crest is far above or below.
        const double reach_mm = wall_.reach_mm * crowding;
        lumen_mm = std::min(lumen_mm, std::max(away_mm - wall.narrowest_mm, -reach_mm));
        lumen_mm = std::max(lumen_mm, std::min(away_mm - wall.widest_mm, reach_mm));
        for (const Polyp* polyp : stretch.polyps)
            lumen_mm = std::max(lumen_mm, polyp->diameter_mm / 2 - distance(p, polyp->position_mm));
        const std::int8_t lumen = stored(lumen_mm), outside = stored(away_mm - wall.outside_mm);
        if (lumen < field.lumen[offset]) {
            field.lumen[offset] = lumen;
            field.pool[offset] = stretch.pool;
        }
        field.outside[offset] = std::min(field.outside[offset], outside);
    }

    /// Rounded so that the sign of the distance survives.
    static std::int8_t stored(double distance_mm)
    {
        return std::int8_t(std::clamp(std::floor(distance_mm / LumenField::kUnit_mm), -127.0, 127.0));
    }

    const Grid& grid_;
    const Course& course_;
    const Wall& wall_;
    std::vector<Stretch> stretches_;
};

}  // namespace

LumenField rasterise(const Grid& grid, const Course& course, const Wall& wall, const std::vector<FluidPool>& pools,
                     Progress& progress)
{
    Rasteriser rasteriser(grid, course, wall, pools);
    const int first = rasteriser.field.low.k;
    tbb::parallel_for(first, first + rasteriser.field.size[2], [&](int k) {
        progress.check();
        rasteriser.slice(k);
    });
    return std::move(rasteriser.field);
}

}  // namespace vicon::phantom
