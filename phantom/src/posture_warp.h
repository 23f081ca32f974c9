#pragma once

#include <cstdint>
#include <vector>

#include "anatomy.h"
#include "folds.h"

namespace vicon::phantom {

/// How strongly the same wall is drawn out in one posture beside another: stations advance by this much more or less.
inline constexpr double kLeastStretch = 0.7, kMostStretch = 1.4;

/// Half of the logarithm of the stretch between a posture and the one opposite to it, at each mm of the patient's
/// colon: it wanders between knots 60 to 200 mm apart, each drawn from the whole range. Any two postures differ by
/// kLeastStretch to kMostStretch.
std::vector<double> halfLogStretch(std::uint64_t seed, Position position, double length_mm);

/// Where each mm of the patient's colon lies in a posture.
struct PostureWarp {
    std::vector<double> station_mm;  ///< never running back
    double at(double wall_mm) const;
    /// The other way.
    double wallAt(double station_mm) const;
};

/// The stretch summed up, free: lengths come out as they do.
PostureWarp freeWarp(const std::vector<double>& half_log_stretch);
/// The same, made to fit the body: the places where the colon is held come to lie where the course has them, but for
/// what the wall slides there.
/// @param wall_mm of those places, ascending, the ends included
/// @param at_mm stations of the same places
PostureWarp heldWarp(const std::vector<double>& half_log_stretch, const std::vector<double>& wall_mm,
                     const std::vector<double>& at_mm);

/// The relief in that posture. Folds and polyps keep their sizes.
/// @param turn angle by which the wall lies turned about the curve
Relief warped(Relief relief, const PostureWarp& warp, double turn);

}  // namespace vicon::phantom
