#pragma once

#include <array>
#include <span>
#include <vector>

namespace vicon::steps {

/// A section of the wall, seen from the line. Ray n of all looks 2 pi n / count about the line.
struct WallRing {
    double along = 0;                  ///< from -1 to 1 over the stretch, 0 at the section that is sought
    std::span<const float> radii_mm;   ///< from the line, one for each ray
    std::span<const float> certainty;  ///< of each radius, from 0 (not met) to 1
};

/// The lumen's cross-section in the middle of a stretch, fitted to the wall of the stretch.
struct SectionFit {
    std::array<double, 2> middle_mm{};  ///< its centroid, beside the line
    double radius_mm = 0;
    double spread_mm = 0;  ///< of the wall about the fit, folds and openings left out
};

/// Fits r = r0 + r1 s + r2 s^2 + r3 s^3 + r4 s^4 + (a0 + a1 s + a2 s^2 + a3 s^3) cos t + (b0 + b1 s + b2 s^2 + b3 s^3)
/// sin t + terms in 2 t and 3 t to the wall: those without t are the lumen's width, narrow at a ring and wide between
/// two; those in t are how far the middle lies beside the line; those in 2 t and 3 t an oval's and three taeniae's.
/// Tukey's biweight leaves out what is far from the others: folds, polyps, openings. All rings have the same number of
/// rays.
SectionFit fitSection(const std::vector<WallRing>& wall);

}  // namespace vicon::steps
