#pragma once

#include <vector>

#include "course.h"
#include "vicon/phantom/phantom.h"

namespace vicon::phantom {

/// Radius of the lumen and of the wall's outside over station and angle. The angle is measured from the course's normal
/// towards its binormal.
class Wall {
public:
    struct Sample {
        double narrowest_mm = 0;       ///< smallest radius of the lumen within reach_mm along the curve
        double widest_mm = 0;          ///< and the largest
        double lumen_mm = 0;           ///< below 0 within a collapsed part
        double lumen_per_station = 0;  ///< slope along the curve
        double lumen_per_radian = 0;   ///< slope around it
        double outside_mm = 0;
    };
    /// Interpolated; the station is clamped to the curve.
    Sample at(double station_mm, double angle) const;
    double largestOutside_mm(double station_mm) const;

    std::vector<CollapsedGap> gaps;
    std::vector<Polyp> polyps;  ///< clock_deg not yet known

    /// Shapes the wall along a course: haustra, folds and polyps are the patient's, gaps are drawn for the position.
    static Wall draw(const PhantomOptions& options, const DrawnCourse& drawn, Position position, double reach_mm);

    double reach_mm = 1;

private:
    static constexpr int kAngles = 192;
    static constexpr double kStep_mm = 0.25;
    float& lumen(std::size_t row, int angle) { return lumen_[row * kAngles + std::size_t(angle)]; }

    void findExtremes();

    std::vector<float> lumen_, outside_;     ///< rows of kAngles, kStep_mm apart
    std::vector<float> narrowest_, widest_;  ///< of lumen_ within reach_mm
    std::vector<float> largest_;             ///< outside, per row
};

}  // namespace vicon::phantom
