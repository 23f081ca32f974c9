#include "vicon/viewer/model/outside_air.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vicon::viewer {
namespace {

/// An oval body in air, with a table below, a tube of gas that leaves the scan at both ends, fluid, and padding in the
/// corners as round fields of view have it.
HuVolume body(const std::array<Vector3, 3>& axis)
{
    HuVolume volume;
    Grid grid;
    grid.size = {90, 70, 20};
    grid.spacing_mm = {1, 1, 2};
    grid.axis = axis;
    grid.origin_mm = {3, -5, 7};
    volume = HuVolume(grid);
    for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
        const Index3 v = grid.indexOf(n);
        const double x = (v.i - 45) / 36.0, y = (v.j - 32) / 26.0;
        const bool tube = std::hypot(v.i - 35, v.j - 30) < 7, fluid = std::hypot(v.i - 60, v.j - 32) < 5;
        const bool corner = std::hypot(v.i - 45, v.j - 35) > 50;
        const bool table = v.j > 62 && v.j < 66;
        volume.voxels[n] = std::int16_t(corner                 ? kPaddingHu
                                        : fluid                ? 400
                                        : tube                 ? -990
                                        : std::hypot(x, y) < 1 ? 30
                                        : table                ? -200
                                                               : -1000);
    }
    return volume;
}

LumenGuess at(const HuVolume& volume, Index3 v)
{
    return guessLumen(volume, volume.grid.pointAt(v));
}

TEST(LumenGuess, TellsAirAroundTheBodyFromGasWithinHoweverTheScanIsStored)
{
    for (const auto& axis : {std::array<Vector3, 3>{Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}},
                             std::array<Vector3, 3>{Vector3{-1, 0, 0}, Vector3{0, -1, 0}, Vector3{0, 0, 1}},
                             std::array<Vector3, 3>{Vector3{0, 1, 0}, Vector3{0, 0, -1}, Vector3{-1, 0, 0}}}) {
        const HuVolume volume = body(axis);
        for (const int k : {0, 10, 19}) {
            EXPECT_EQ(at(volume, {35, 30, k}), LumenGuess::possible) << "gas, also where it leaves the scan";
            EXPECT_EQ(at(volume, {60, 32, k}), LumenGuess::possible) << "fluid";
            EXPECT_EQ(at(volume, {45, 60, k}), LumenGuess::outside_body) << "between body and table";
            EXPECT_EQ(at(volume, {2, 35, k}), LumenGuess::outside_body);
            EXPECT_EQ(at(volume, {1, 1, k}), LumenGuess::outside_body) << "padding";
            EXPECT_EQ(at(volume, {11, 32, k}), LumenGuess::outside_body) << "in the skin, beside air";
            EXPECT_EQ(at(volume, {47, 20, k}), LumenGuess::tissue);
            EXPECT_EQ(at(volume, {47, 90, k}), LumenGuess::outside_body) << "beyond the scan";
        }
    }
}

}  // namespace
}  // namespace vicon::viewer
