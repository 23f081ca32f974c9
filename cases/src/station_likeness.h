#pragma once

#include <array>
#include <vector>

#include "profile_features.h"
#include "vicon/core/progress.h"

namespace vicon {

/// What speaks for two places of two scans being one, for all that a chain asks: places between the steps of the
/// first centreline, each with the stations of the second within reach, at each turn of the wall.
class StationLikeness {
public:
    /// Of a step along the first centreline.
    static constexpr std::array<double, 4> kSamples{0.125, 0.375, 0.625, 0.875};

    /// @param from_mm where the steps of the first centreline begin, `step_mm` long
    /// @param lowest_mm the first station of the second centreline that each is compared with
    /// @param columns stations compared with, each 1 mm on
    /// @param wanted throws Error{cancelled} where it is no longer; nothing: it always is
    StationLikeness(const ProfileFeatures& here, const ProfileFeatures& there, const std::vector<double>& from_mm,
                    double step_mm, const std::vector<int>& lowest_mm, std::size_t columns, const Progress* wanted);

    /// How many turns are told apart: 1 where a relief is not known.
    std::size_t turns() const { return turns_; }
    /// Factors, by column: above 1 where the two are more alike than any two places.
    const float* of(std::size_t node, std::size_t turn, std::size_t sample) const
    {
        return &factor_[((node * turns_ + turn) * kSamples.size() + sample) * columns_];
    }

private:
    void compare(std::size_t node, std::size_t sample, long here, int lowest);
    /// By width and clearance.
    float along(std::size_t here, std::size_t there) const;
    using Turns = std::array<float, ProfileFeatures::kSectors>;
    /// By the folds about it, at each turn.
    Turns about(std::size_t here, std::size_t there) const;

    const ProfileFeatures &here_, &there_;
    std::size_t turns_, columns_;
    std::vector<float> factor_;
};

}  // namespace vicon
