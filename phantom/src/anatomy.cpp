#include "anatomy.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vicon/core/error.h"

namespace vicon::phantom {
namespace {

struct Level {
    double z, half_x, half_y, centre_y;
};

/// Interpolates a table of levels.
Level at(const auto& table, double z)
{
    if (z <= table.front().z)
        return table.front();
    for (std::size_t n = 1; n < table.size(); ++n) {
        if (z > table[n].z)
            continue;
        const Level &a = table[n - 1], &b = table[n];
        const double t = (z - a.z) / (b.z - a.z);
        const auto mixed = [t](double from, double to) { return from + (to - from) * t; };
        return {z, mixed(a.half_x, b.half_x), mixed(a.half_y, b.half_y), mixed(a.centre_y, b.centre_y)};
    }
    return table.back();
}

constexpr std::array<Level, 6> kSkin{{{0, 172, 108, 0},
                                      {60, 180, 114, 0},
                                      {120, 178, 114, 0},
                                      {210, 166, 112, 0},
                                      {300, 168, 114, 0},
                                      {430, 174, 116, 0}}};
constexpr std::array<Level, 6> kCavity{
    {{20, 52, 56, 28}, {60, 64, 72, 20}, {100, 82, 82, 8}, {140, 122, 90, -2}, {200, 142, 93, -4}, {430, 144, 93, -4}}};

}  // namespace

Placement placementFrom(const std::string& name)
{
    for (const bool feet_first : {false, true})
        for (const auto& [suffix, position] : {std::pair{"S", Position::supine},
                                               {"P", Position::prone},
                                               {"DL", Position::left},
                                               {"DR", Position::right}})
            if (name == std::string(feet_first ? "FF" : "HF") + suffix)
                return {position, feet_first};
    throw Error(ErrorCode::wrong_use, "no such patient position", name,
                "use HFS, HFP, HFDL, HFDR, FFS, FFP, FFDL or FFDR");
}

Vector3 gravityOf(Position position)
{
    switch (position) {
        case Position::supine:
            return {0, 1, 0};
        case Position::prone:
            return {0, -1, 0};
        case Position::left:
            return {1, 0, 0};
        case Position::right:
            return {-1, 0, 0};
    }
    throw Error(ErrorCode::internal, "no such position");
}

double Oval::value(double x, double y) const
{
    return std::pow(std::abs(x) / half_x_mm, exponent) + std::pow(std::abs(y - centre_y_mm) / half_y_mm, exponent);
}

Oval Trunk::skin(double z) const
{
    const Level level = at(kSkin, z);
    return {level.half_x * build, level.half_y * build - flatten_front / 2, level.centre_y + flatten_front / 2, 2.4};
}

Oval Trunk::cavity(double z) const
{
    const Level level = at(kCavity, z);
    return {level.half_x * build, level.half_y * build - flatten_front / 2, level.centre_y + flatten_front / 2, 3};
}

double Trunk::diaphragm(double x, double y) const
{
    // Two domes, the right one higher; each falls off towards the ribs, most at the back.
    const double right = 398 - std::pow((x + 72) / 11, 2) - std::pow((y + 5) / 15, 2);
    const double left = 392 - std::pow((x - 78) / 11, 2) - std::pow((y + 5) / 15, 2);
    return std::max({right, left, 345 + 22 * std::clamp(-y / 80, 0.0, 1.0)});
}

std::vector<Ellipsoid> obstacles()
{
    return {
        {{0, 82, 300}, {36, 44, 190}},    // spine with the great vessels before it
        {{0, 98, 85}, {40, 9, 34}},       // sacrum
        {{-70, -20, 365}, {84, 78, 62}},  // liver
        {{46, -22, 350}, {42, 38, 27}},   // stomach
        {{64, 52, 285}, {30, 26, 50}},    // kidneys
        {{-64, 52, 270}, {30, 26, 50}},   //
        {{0, -32, 62}, {40, 30, 30}},     // bladder
        {{104, 46, 366}, {30, 36, 28}},   // spleen
    };
}

std::vector<WayPoint> usualWay()
{
    return {
        {{0, 44, 46}, 15, 0},         {{0, 53, 66}, 22, 0},       {{-2, 57, 92}, 23, 0.05},       // rectum
        {{2, 48, 122}, 17, 0.3},                                                                  // rectosigmoid
        {{-26, 26, 144}, 15, 0.8},    {{-52, 4, 160}, 15, 1},     {{-40, -34, 176}, 15.5, 1},     // sigmoid
        {{-4, -50, 172}, 15.5, 1},    {{32, -48, 146}, 15, 1},    {{64, -30, 122}, 15, 0.8},      //
        {{96, -4, 132}, 15, 0.3},     {{112, 20, 168}, 16, 0.05}, {{117, 34, 210}, 16.5, 0},      // descending
        {{118, 38, 260}, 17, 0},      {{116, 36, 300}, 17.5, 0},  {{108, 20, 328}, 18, 0.1},      // splenic flexure
        {{98, -14, 322}, 19, 0.4},    {{84, -46, 296}, 20, 0.8},  {{58, -64, 262}, 20.5, 1},      // transverse
        {{22, -70, 236}, 21, 1},      {{-18, -70, 230}, 21, 1},   {{-56, -64, 242}, 21.5, 1},     //
        {{-86, -44, 262}, 21.5, 0.6}, {{-108, -8, 276}, 22, 0.2}, {{-116, 24, 264}, 22.5, 0.05},  // hepatic flexure
        {{-117, 36, 230}, 23, 0},     {{-116, 34, 195}, 24, 0},   {{-110, 24, 160}, 25.5, 0.05},  // ascending
        {{-100, 8, 132}, 26, 0.15},   {{-92, 0, 116}, 23, 0.2},                                   // caecum
    };
}

}  // namespace vicon::phantom
