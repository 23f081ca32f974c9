#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace vicon {

/// A size, and how it was measured.
struct MeasuredSize {
    std::optional<double> size_mm;
    std::string from;                         ///< "best plane", "surface", "reader", ...
    std::optional<double> least_mm, most_mm;  ///< eight in ten lie between; absent: measured by hand
    std::optional<double> volume_ml;
    std::optional<double> volume_least_ml, volume_most_ml;  ///< likewise; absent: by the diameter's
    std::string kernel;
    double slice_thickness_mm = 0;  ///< 0: not said
    std::string date;               ///< of the examination, YYYYMMDD
};
nlohmann::json toJson(const MeasuredSize& size);
/// Throws nlohmann::json::exception.
MeasuredSize measuredSizeFromJson(const nlohmann::json& json);

/// A difference with its interval of 80 %.
struct Change {
    double about = 0, least = 0, most = 0;
};

enum class GrowthVerdict { grew, stable, shrank, not_sure };
/// "grew", "stable", "shrank", "not sure".
std::string nameOf(GrowthVerdict verdict);

/// What became of a finding between two examinations.
struct Growth {
    std::optional<double> years;           ///< between them
    std::optional<Change> diameter_mm;     ///< absent: `why_not` says why
    std::optional<Change> volume_percent;  ///< in all; absent where no volume is known of both
    std::optional<Change> percent_a_year;  ///< of the volume
    std::optional<GrowthVerdict> verdict;  ///< absent: none can be given
    std::string why_not;                   ///< in words; empty where nothing keeps it from being told
};
nlohmann::json toJson(const Growth& growth);
/// Throws nlohmann::json::exception.
Growth growthFromJson(const nlohmann::json& json);

/// Sizes are compared only where they were taken in the same way from slices of the same kernel and thickness, which
/// are thin enough; else `why_not` says what differs. A volume that changed by 20 % a year or more grew or shrank,
/// where no change lies outside its interval (Pickhardt et al., Lancet Oncol 2013, PMC4018232).
Growth growthBetween(const MeasuredSize& before, const MeasuredSize& now);

/// "+2.1 mm (0.9 to 3.3), volume +88 % (31 to 145), 59 % a year (21 to 97) in 1.5 years: grew"; else why it is not
/// told.
std::string growthWords(const Growth& growth);

}  // namespace vicon
