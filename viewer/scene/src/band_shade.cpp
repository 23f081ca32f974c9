#include "band_shade.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>

#include "seen_tint.h"

namespace vicon::viewer {
namespace {

constexpr Rgb kBandGround{10, 13, 18};
constexpr std::array kBandWall{0.93, 0.66, 0.56};
constexpr Rgb kHatch{95, 115, 185};                    // seen on light and dark wall
constexpr double kHatchStrength = 0.4;                 // what lies below is read through it
constexpr double kLeastFactor = 0.5, kMostFactor = 2;  // of areas; beyond it is hatched
constexpr double kRepeated = 0.5;                      // of the light
constexpr double kBandClosedLight = 0.5;

struct Light {
    double red = 0, green = 0, blue = 0;
};

/// The directions of a picture's column, in the scan.
struct Column {
    PathFrame frame;
    double sign = 1;  // of the way along a row
};

/// What is left of the light that falls on a wall: from the path, and more of it from the upper left.
double lightOn(Vector3 normal, Vector3 outwards, const Column& column)
{
    const Vector3 right = column.frame.forward * column.sign;
    const Vector3 up = cross(right, outwards);
    const Vector3 to_lamp = normalized(-outwards - right * 0.7 + up * 0.7);
    const double facing = std::max(0.0, dot(normal, to_lamp));
    return 0.3 + 0.7 * facing;
}

/// One wall of one picture.
class BandShader {
public:
    BandShader(const BandMap& band, const BandRaster& raster, int finer, const std::vector<std::uint8_t>& seen,
               const std::vector<float>& openness)
        : band_(band), raster_(raster), finer_(finer), seen_(seen), openness_(openness)
    {
        const BandPage& page = raster.page();
        for (int row = 0; row < page.rows; ++row)
            for (int x = 0; x < page.width; ++x)
                columns_.push_back({band.path().at(page.placeAt(band, {x + 0.5, page.rowTop(row) + 1}).station_mm),
                                    page.from_caecum ? -1.0 : 1.0});
    }

    Light at(int x, int y) const
    {
        const auto hit = raster_.at(x, y);
        const BandPage& page = raster_.page();
        const BandPlace place = page.placeAt(band_, {x + 0.5, y + 0.5});
        constexpr double kEdge_rad = BandPage::kTurn_rad / 2 + BandPage::kBeyond_rad;
        if (!hit || std::abs(place.around_rad) > kEdge_rad)
            return {kBandGround.red / 255.0, kBandGround.green / 255.0, kBandGround.blue / 255.0};
        const CellSurface& surface = band_.surface();
        const std::uint32_t* corner = &surface.triangles[3 * std::size_t(hit->triangle)];
        Vector3 normal;
        double open = 0, factor = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const float* n = &surface.normals[3 * std::size_t(corner[k])];
            normal += Vector3{n[0], n[1], n[2]} * hit->weights[k];
            open += (openness_.empty() ? 1 : double(openness_[corner[k]])) * hit->weights[k];
            factor += band_.areaFactor(corner[k]) * hit->weights[k];
        }
        const int row = page.rowAt({x + 0.5, y + 0.5});
        const Column& column = columns_[std::size_t(row) * std::size_t(page.width) + std::size_t(x)];
        const Vector3 right = cross(column.frame.forward, column.frame.up);
        const Vector3 outwards = column.frame.up * std::cos(place.around_rad) + right * std::sin(place.around_rad);
        double light = lightOn(normalized(normal), outwards, column);
        light *= std::lerp(kBandClosedLight, 1.0, open);
        if (std::abs(place.around_rad) > BandPage::kTurn_rad / 2)
            light *= kRepeated;
        return hatched(painted(light, hit->triangle), factor, x, y);
    }

private:
    Light painted(double light, std::uint32_t triangle) const
    {
        const auto byte = [&](std::size_t c) {
            return std::uint8_t(std::lround(255 * std::min(1.0, kBandWall[c] * light)));
        };
        Rgb color{byte(0), byte(1), byte(2)};
        if (triangle < seen_.size() && seen_[triangle])
            color = seenTint(color);
        return {color.red / 255.0, color.green / 255.0, color.blue / 255.0};
    }

    Light hatched(Light own, double factor, int x, int y) const
    {
        constexpr int kEvery_px = 9;
        const bool off = factor < kLeastFactor || factor > kMostFactor;
        if (!off || (x + y) / finer_ % kEvery_px != 0)
            return own;
        return {std::lerp(own.red, kHatch.red / 255.0, kHatchStrength),
                std::lerp(own.green, kHatch.green / 255.0, kHatchStrength),
                std::lerp(own.blue, kHatch.blue / 255.0, kHatchStrength)};
    }

    const BandMap& band_;
    const BandRaster& raster_;
    int finer_;
    const std::vector<std::uint8_t>& seen_;
    const std::vector<float>& openness_;
    std::vector<Column> columns_;  // of each row
};

}  // namespace

Picture bandWall(const BandMap& band, const BandRaster& raster, int finer, const std::vector<std::uint8_t>& seen,
                 const std::vector<float>& openness, Progress& progress)
{
    const BandPage& page = raster.page();
    Picture picture(page.width / finer, page.height / finer, kBandGround);
    const BandShader shader(band, raster, finer, seen, openness);
    tbb::parallel_for(0, picture.height, [&](int y) {
        if (progress.cancelled())
            return;
        for (int x = 0; x < picture.width; ++x) {
            Light sum;
            for (int part = 0; part < finer * finer; ++part) {
                const Light light = shader.at(x * finer + part % finer, y * finer + part / finer);
                sum.red += light.red;
                sum.green += light.green;
                sum.blue += light.blue;
            }
            const auto byte = [&](double value) { return std::uint8_t(std::lround(255 * value / (finer * finer))); };
            picture.set(x, y, {byte(sum.red), byte(sum.green), byte(sum.blue)});
        }
    });
    progress.check();
    return picture;
}

}  // namespace vicon::viewer
