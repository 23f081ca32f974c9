#include "vicon/viewer/model/peeling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "density_sampler.h"
#include "transfer_table.h"
#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

constexpr double kFarthest_mm = 500;        // longer than any colon is wide: no ray needs more to meet a wall
constexpr float kLightThatCounts = 0.001F;  // a quarter of a grey level
constexpr float kOpacityThatIsShaded = 0.004F;
constexpr double kMostPixels = 4096;
// As the lamp of the surface's picture (scene/surface_scene.cpp), so that the two fit together.
constexpr double kLeastLight = 0.16, kFacingLight = 0.84, kExposure = 1.12;

struct Light {
    std::array<float, 3> colour{};
    float left = 1;  // of the light, not yet stopped
};

class Caster {
public:
    Caster(const HuVolume& volume, const Lumen& lumen, const Pose& pose, const TransferFunction& colours,
           const PeelingOptions& options)
        : densities_(volume), lumen_(lumen), pose_(pose), colours_(colours, options.step_mm), options_(options)
    {
    }

    Light cast(Vector3 direction) const
    {
        Light light;
        const auto wall = distanceToWall_mm(lumen_, pose_.eye_mm, direction, kFarthest_mm);
        if (!wall)
            return light;
        const double begin = (options_.begin == PeelingOptions::Begin::wall ? *wall : 0) + options_.offset_mm;
        const double end = *wall + options_.offset_mm + options_.reach_mm;
        const ContinuousIndex3 eye = densities_.indexAt(pose_.eye_mm), unit = densities_.indexStep(direction);
        for (double n = std::ceil(begin / options_.step_mm); n * options_.step_mm <= end; ++n) {
            const double t = n * options_.step_mm;
            add(light, eye.i + unit.i * t, eye.j + unit.j * t, eye.k + unit.k * t, t, direction);
            if (light.left < kLightThatCounts)
                break;
        }
        return light;
    }

private:
    void add(Light& light, double x, double y, double z, double t, Vector3 direction) const
    {
        float density_hu = 0;
        if (!densities_.sample(x, y, z, density_hu))
            return;
        const TransferTable::Entry& entry = colours_.at(density_hu);
        if (entry.opacity <= 0)
            return;
        const float weight = light.left * entry.opacity;
        const float strength = weight * (weight > kOpacityThatIsShaded ? lamp(x, y, z, t, direction) : fade(t));
        for (std::size_t c = 0; c < 3; ++c)
            light.colour[c] += strength * entry.colour[c];
        light.left -= weight;
    }

    float fade(double t) const
    {
        return float(kExposure / (1 + t * t / (options_.lamp_half_mm * options_.lamp_half_mm)));
    }

    float lamp(double x, double y, double z, double t, Vector3 direction) const
    {
        if (!options_.shaded)
            return fade(t);
        const Vector3 gradient = densities_.gradient(x, y, z);
        const double steep = length(gradient);
        // A border between densities shines when it faces the lamp; inside even tissue there is none to face it.
        const double facing = steep > 0 ? std::abs(dot(gradient, direction)) / steep : 1;
        const double edge = steep / (steep + kEvenTissue_hu);
        return float((kLeastLight + kFacingLight * std::lerp(1.0, facing, edge)) * fade(t));
    }

    static constexpr double kEvenTissue_hu = 60;  // three times the noise of a colonography at 50 mAs

    DensitySampler densities_;
    const Lumen& lumen_;
    Pose pose_;
    TransferTable colours_;
    PeelingOptions options_;
};

void check(const Lens& lens, const PeelingOptions& options)
{
    if (lens.width < 1 || lens.height < 1 || lens.width > kMostPixels || lens.height > kMostPixels)
        throw Error(ErrorCode::wrong_use, "a picture has 1 to 4096 pixels a side",
                    std::to_string(lens.width) + " x " + std::to_string(lens.height));
    if (!(options.step_mm >= 0.1 && options.step_mm <= 2))
        throw Error(ErrorCode::wrong_use, "peeling steps are 0.1 to 2 mm long", std::to_string(options.step_mm));
}

std::uint8_t byteOf(float share)
{
    return std::uint8_t(std::lround(std::clamp(share, 0.F, 1.F) * 255));
}

}  // namespace

std::optional<double> distanceToWall_mm(const Lumen& lumen, Point3 from, Vector3 direction, double reach_mm)
{
    const double near = lumen.voxel_mm() / 2;
    double before = 0;
    for (double at = 0; at <= reach_mm;) {
        const Point3 p = from + direction * at;
        const double free = lumen.freeBall_mm(p);
        if (free > near) {
            before = at;
            at += std::max(free - near, near / 2);
            continue;
        }
        const double clearance = lumen.clearance_mm(p);
        if (clearance > near) {
            before = at;
            at += near / 2;
            continue;
        }
        for (int halving = 0; halving < 6; ++halving) {
            const double middle = (before + at) / 2;
            (lumen.clearance_mm(from + direction * middle) > near ? before : at) = middle;
        }
        return at;
    }
    return {};
}

PeeledPicture peel(const HuVolume& volume, const Lumen& lumen, const Pose& pose, const Lens& lens,
                   const TransferFunction& colours, const PeelingOptions& options,
                   const std::optional<PictureCircle>& only)
{
    check(lens, options);
    PeeledPicture picture{lens.width, lens.height, {}};
    picture.rgba.assign(std::size_t(lens.width) * std::size_t(lens.height) * 4, 0);
    const Caster caster(volume, lumen, pose, colours, options);
    tbb::parallel_for(0, lens.height, [&](int y) {
        for (int x = 0; x < lens.width; ++x) {
            const Pixel pixel{x + 0.5, y + 0.5};
            if (only && !only->holds(pixel))
                continue;
            const Light light = caster.cast(rayThrough(pose, lens, pixel));
            std::uint8_t* out = &picture.rgba[4 * (std::size_t(y) * std::size_t(lens.width) + std::size_t(x))];
            for (std::size_t c = 0; c < 3; ++c)
                out[c] = byteOf(light.colour[c]);
            out[3] = byteOf(1 - light.left);
        }
    });
    return picture;
}

void blendOver(std::vector<std::uint8_t>& rgb, const PeeledPicture& peeled, double weight)
{
    for (std::size_t n = 0; n < rgb.size() / 3; ++n) {
        const std::uint8_t* over = &peeled.rgba[4 * n];
        for (std::size_t c = 0; c < 3; ++c) {
            const double mixed = weight * over[c] + (1 - weight * over[3] / 255.0) * rgb[3 * n + c];
            rgb[3 * n + c] = std::uint8_t(std::lround(std::clamp(mixed, 0.0, 255.0)));
        }
    }
}

}  // namespace vicon::viewer
