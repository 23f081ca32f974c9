#pragma once

#include <array>
#include <cstdint>

#include "scene.h"

namespace vicon::phantom {

/// |u|^p by table: the trunk's outlines are asked for at every voxel.
class PowerTable {
public:
    explicit PowerTable(double exponent);
    double operator()(double u) const;

private:
    static constexpr int kEntries = 2048;
    static constexpr double kLargest = 2;
    std::array<float, kEntries + 2> values_{};
};

/// Paints what fills the trunk and what lies around it, one slice at a time.
class TrunkPainter {
public:
    explicit TrunkPainter(const Scene& scene);

    /// Air, table, skin, fat, muscles and the fat between the organs.
    void body(const Grid& grid, int k, std::int16_t* out) const;
    void lungs(const Grid& grid, int k, std::int16_t* out) const;
    /// Padding outside the circle that the scanner reconstructs.
    void beyondCircle(const Grid& grid, std::int16_t* out) const;

private:
    double tableDensity(Point3 p) const;

    const Scene& scene_;
    PowerTable skin_, cavity_;
};

}  // namespace vicon::phantom
