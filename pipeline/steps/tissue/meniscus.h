#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

#include "tissue/level_voxels.h"

namespace vicon::steps {

/// How much higher than its level fluid stands beside a wall, as far from it as the blur reaches: the more, the more
/// the wall hangs over the fluid; at a beach it may stand lower.
struct MeniscusShape {
    double beside_upright_mm = 0;
    double per_radian_mm = 0;  ///< for each radian by which a wall hangs over
    /// @param overhang radians from upright, negative at a beach
    double rise_mm(double overhang) const { return beside_upright_mm + per_radian_mm * overhang; }
};

/// What one place beside a wall says of it: how far its density lies from what it would be if the wall went on straight
/// through the level and fluid stood so and so high.
struct MeniscusPlace {
    // The heights tried: -0.6 to 2.4 mm. No case recorded; reason: kMeniscus_mm lies well within.
    static constexpr std::size_t kHeights = 11;
    static constexpr double kLowest_mm = -0.6, kStep_mm = 0.3;
    static constexpr double height_mm(std::size_t n) { return kLowest_mm + kStep_mm * double(n); }

    double overhang = 0;  ///< radians
    std::array<float, kHeights> misses_hu{};
};

/// Fits a meniscus to many places.
class MeniscusFit {
public:
    void add(const MeniscusPlace& place);
    void add(const MeniscusFit& other, double weight);
    double places() const;
    /// What all places together miss when fluid stands so.
    double missOf_hu(const MeniscusShape& meniscus) const;
    MeniscusShape best() const;

private:
    static constexpr std::size_t kLeans = 6;  ///< of 30 degrees each
    double missOf_hu(std::size_t lean, double rise_mm) const;

    std::array<double, kLeans> places_{};
    std::array<std::array<double, MeniscusPlace::kHeights>, kLeans> misses_hu_{};
};

/// How fluid stands beside the walls of a scan.
class Menisci {
public:
    /// Nothing is known of it yet: a plane, or higher.
    Menisci() = default;
    /// @param places of each voxel; nothing where it tells nothing
    Menisci(const LevelVoxels& voxels, const std::vector<std::optional<MeniscusPlace>>& places, double noise_hu);

    /// That of the whole scan; a plane where too few places tell.
    const MeniscusShape& usual() const { return usual_; }
    /// As high as fluid may stand beside a voxel's wall: higher than usual where the densities around do not fit that.
    double mayRise_mm(Index3 v, double overhang) const;

private:
    bool known_ = false;
    MeniscusShape usual_;
    std::unordered_map<std::size_t, float> may_rise_mm_;  ///< by cell, where it differs
};

}  // namespace vicon::steps
