#include "vicon/viewer/model/peeling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "density_sampler.h"
#include "transfer_table.h"
#include "vicon/core/error.h"
#include "wall_rays.h"

namespace vicon::viewer {
namespace {

constexpr double kFarthest_mm = 500;  // longer than any colon is wide: no ray needs more to meet a wall
constexpr double kMostPixels = 4096;
constexpr int kTile = 8;  // pixels that are cast together: a beam through them finds what is free for all
// As the lamp of the surface's picture (scene/lamp_shader.cpp), so that the two fit together.
constexpr float kLeastLight = 0.16F, kFacingLight = 0.84F;
constexpr double kExposure = 1.12;

struct Light {
    std::array<float, 3> colour{};
    float left = 1;  // of the light, not yet stopped
};

class Caster {
public:
    Caster(const DensityBricks& volume, const Lumen& lumen, const Pose& pose, const Lens& lens,
           const TransferFunction& colours, const PeelingOptions& options)
        : bricks_(volume),
          densities_(volume.volume()),
          walls_(lumen, pose.eye_mm),
          eye_(densities_.indexAt(pose.eye_mm)),
          pose_(pose),
          lens_(lens),
          colours_(colours, options.step_mm),
          options_(options)
    {
        const double farthest = kFarthest_mm + std::max(0.0, options.offset_mm) + options.reach_mm;
        for (double t = 0; t <= farthest + options.step_mm; t += options.step_mm)
            fade_.push_back(
                float(std::sqrt(kExposure / (1 + t * t / (options.lamp_reach_mm * options.lamp_reach_mm)))));
    }

    /// Hands the light of each pixel of a tile to `take`.
    template <class Take>
    void castTile(int left, int top, const Take& take) const
    {
        const int right = std::min(left + kTile, lens_.width), bottom = std::min(top + kTile, lens_.height);
        const Vector3 middle = rayThrough(pose_, lens_, {(left + right) / 2.0, (top + bottom) / 2.0});
        double spread = 0;
        for (const Pixel corner : {Pixel{double(left), double(top)}, Pixel{double(right), double(top)},
                                   Pixel{double(left), double(bottom)}, Pixel{double(right), double(bottom)}})
            spread = std::max(spread, length(rayThrough(pose_, lens_, corner) - middle));
        const double free_mm = walls_.freeBeam_mm(middle, spread, kFarthest_mm);
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x)
                take(x, y, [&] { return cast(rayThrough(pose_, lens_, {x + 0.5, y + 0.5}), free_mm); });
    }

private:
    Light cast(Vector3 direction, double free_mm) const
    {
        Light light;
        const auto wall = walls_.along(direction, free_mm, kFarthest_mm);
        if (!wall)
            return light;
        const double begin = (options_.begin == PeelingOptions::Begin::wall ? *wall : 0) + options_.offset_mm;
        const double end = *wall + std::max(0.0, options_.offset_mm) + options_.reach_mm;
        const auto first = std::size_t(std::ceil(std::max(0.0, begin) / options_.step_mm));
        const auto last = std::min(std::size_t(end / options_.step_mm), fade_.size() - 1);
        const DensitySampler::Place unit = densities_.indexStep(direction);
        Brick brick;
        for (std::size_t n = first; n <= last && light.left >= float(options_.least_light); ++n) {
            const float t = float(n) * float(options_.step_mm);
            const DensitySampler::Place p{eye_.x + unit.x * t, eye_.y + unit.y * t, eye_.z + unit.z * t};
            if (!densities_.holds(p))
                continue;
            enter(brick, p);
            if (brick.shows)
                add(light, p, fade_[n], unit, brick.padding);
            else
                n = std::max(n, lastWithin(p, unit));
        }
        return light;
    }

    /// The brick that a ray is in.
    struct Brick {
        std::size_t number = SIZE_MAX;
        bool shows = false, padding = false;
    };
    void enter(Brick& brick, DensitySampler::Place p) const
    {
        const std::size_t number = bricks_.brickOf(int(p.x), int(p.y), int(p.z));
        if (number == brick.number)
            return;
        const DensityBricks::Range range = bricks_.around(number);
        brick = {number, colours_.shows(range.lowest, range.highest), range.padding};
    }

    // Number of the last sample in the brick of `p`, or one that rounding puts just behind it: its range covers that.
    std::size_t lastWithin(DensitySampler::Place p, DensitySampler::Place unit) const
    {
        const auto reach = [](float at, float eye, float step) {
            constexpr float kFar = 1e9F, kEdge = DensityBricks::kEdge;
            const float side = std::floor(at / kEdge) * kEdge + (step > 0 ? kEdge : 0);
            return step == 0 ? kFar : (side - eye) / step;
        };
        const float t = std::min({reach(p.x, eye_.x, unit.x), reach(p.y, eye_.y, unit.y), reach(p.z, eye_.z, unit.z)});
        return std::size_t(std::max(0.F, t / float(options_.step_mm)));
    }

    void add(Light& light, DensitySampler::Place p, float fade, DensitySampler::Place unit, bool padding) const
    {
        float density_hu = 0;
        if (!densities_.sample(p, padding, density_hu))
            return;
        const TransferTable::Entry& entry = colours_.at(density_hu);
        if (entry.opacity <= 0)
            return;
        const float weight = light.left * entry.opacity;
        const bool lit = options_.shaded && weight > float(options_.shaded_from);
        const float strength = weight * fade * (lit ? facing(p, unit, padding) : 1);
        for (std::size_t c = 0; c < 3; ++c)
            light.colour[c] += strength * entry.colour[c];
        light.left -= weight;
    }

    float facing(DensitySampler::Place p, DensitySampler::Place unit, bool padding) const
    {
        const DensitySampler::Slope slope = densities_.slope(p, unit, padding);
        // A border between densities shines when it faces the lamp; inside even tissue there is none to face it.
        const float cosine = slope.steep > 0 ? std::abs(slope.along) / slope.steep : 1;
        const float edge = slope.steep / (slope.steep + kEvenTissue_hu);
        return kLeastLight + kFacingLight * (1 + edge * (cosine - 1));
    }

    static constexpr float kEvenTissue_hu = 60;  // three times the noise of a colonography at 50 mAs

    const DensityBricks& bricks_;
    DensitySampler densities_;
    WallRays walls_;
    DensitySampler::Place eye_;
    Pose pose_;
    Lens lens_;
    TransferTable colours_;
    PeelingOptions options_;
    std::vector<float> fade_;  // of the lamp, step by step
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
    return WallRays(lumen, from).along(direction, 0, reach_mm);
}

PeeledPicture peel(const DensityBricks& volume, const Lumen& lumen, const Pose& pose, const Lens& lens,
                   const TransferFunction& colours, const PeelingOptions& options,
                   const std::optional<PictureCircle>& only, const Progress* wanted)
{
    check(lens, options);
    PeeledPicture picture{lens.width, lens.height, {}};
    picture.rgba.assign(std::size_t(lens.width) * std::size_t(lens.height) * 4, 0);
    const Caster caster(volume, lumen, pose, lens, colours, options);
    const auto take = [&](int x, int y, const auto& cast) {
        if (only && !only->holds({x + 0.5, y + 0.5}))
            return;
        const Light light = cast();
        std::uint8_t* out = &picture.rgba[4 * (std::size_t(y) * std::size_t(lens.width) + std::size_t(x))];
        for (std::size_t c = 0; c < 3; ++c)
            out[c] = byteOf(light.colour[c]);
        out[3] = byteOf(1 - light.left);
    };
    tbb::parallel_for(0, (lens.height + kTile - 1) / kTile, [&](int tile_row) {
        if (wanted)
            wanted->check();
        for (int left = 0; left < lens.width; left += kTile)
            caster.castTile(left, tile_row * kTile, take);
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
