#include "lay_down.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vicon::viewer {
namespace {

constexpr int kAlong = 60, kAround = 48;
constexpr double kPi = std::numbers::pi;

std::uint32_t pointAt(int along, int around)
{
    return std::uint32_t(along * kAround + (around + kAround) % kAround);
}

/// The places of a tube's wall, of which a part leans back over what lies before it.
struct Tube {
    CellSurface surface;
    std::vector<float> station_mm, around_rad;

    explicit Tube(double leans_mm)
    {
        for (int s = 0; s < kAlong; ++s)
            for (int a = 0; a < kAround; ++a) {
                const double angle_rad = 2 * kPi * a / kAround - kPi;
                // Sine over a patch of 20 rings and a third of the turn: its flank goes back where it is steep.
                const double in = std::max(0.0, 1 - std::pow((s - 30) / 10.0, 2)),
                             side = std::max(0.0, 1 - std::pow(angle_rad / (kPi / 3), 2));
                surface.points_mm.insert(surface.points_mm.end(),
                                         {float(std::cos(angle_rad)), float(std::sin(angle_rad)), float(s)});
                station_mm.push_back(float(s + leans_mm * in * side));
                around_rad.push_back(float(angle_rad));
            }
        for (int s = 0; s + 1 < kAlong; ++s)
            for (int a = 0; a < kAround; ++a)
                surface.triangles.insert(surface.triangles.end(),
                                         {pointAt(s, a), pointAt(s + 1, a), pointAt(s + 1, a + 1), pointAt(s, a),
                                          pointAt(s + 1, a + 1), pointAt(s, a + 1)});
    }

    std::size_t folded() const
    {
        std::size_t count = 0;
        for (std::size_t t = 0; t < surface.triangleCount(); ++t) {
            const std::uint32_t* c = &surface.triangles[3 * t];
            const auto x = [&](int k) { return double(station_mm[c[k]]) - station_mm[c[0]]; };
            const auto y = [&](int k) { return std::remainder(double(around_rad[c[k]]) - around_rad[c[0]], 2 * kPi); };
            count += x(1) * y(2) - y(1) * x(2) < 0 ? 1 : 0;
        }
        return count;
    }

    void layDown()
    {
        NoProgress quiet;
        viewer::layDown(station_mm, around_rad, surface, SurfaceNeighbors(surface), quiet);
    }
};

TEST(LayDown, NothingIsFoldedAnyMoreAndWhatLiesFarStays)
{
    Tube tube(20);
    const Tube before = tube;
    ASSERT_GT(before.folded(), 100U);
    tube.layDown();
    EXPECT_EQ(tube.folded(), 0U);
    for (const int s : {0, kAlong - 1})
        for (int a = 0; a < kAround; ++a)
            EXPECT_EQ(tube.station_mm[pointAt(s, a)], before.station_mm[pointAt(s, a)]) << s << " " << a;
}

TEST(LayDown, WhatIsFlatStaysAsItIs)
{
    Tube tube(2);
    const Tube before = tube;
    ASSERT_EQ(before.folded(), 0U);
    tube.layDown();
    EXPECT_EQ(tube.station_mm, before.station_mm);
    EXPECT_EQ(tube.around_rad, before.around_rad);
}

}  // namespace
}  // namespace vicon::viewer
