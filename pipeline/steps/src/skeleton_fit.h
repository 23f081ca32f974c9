#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace vicon::steps {

/// A point of the wall, seen from the line: where along the stretch, in which direction, how far.
struct WallPoint {
    double along = 0;      ///< from -1 to 1 over the stretch, 0 at the section that is sought
    double angle = 0;      ///< rad
    double radius_mm = 0;  ///< from the line
};

/// The lumen's cross-section in the middle of a stretch, fitted to the wall of the stretch.
struct SectionFit {
    std::array<double, 2> middle_mm{};  ///< its centroid, beside the line
    double radius_mm = 0;
    double spread_mm = 0;  ///< of the wall about the fit, folds and openings left out
};

/// Fits r = r0 + r1 s + (a0 + a1 s + a2 s^2) cos t + (b0 + b1 s + b2 s^2) sin t + terms in 2 t and 3 t to the wall: the
/// terms in t are how far the middle lies beside the line; those in 2 t and 3 t an oval's and three taeniae's. Tukey's
/// biweight leaves out what is far from the others: folds, polyps, openings.
SectionFit fitSection(const std::vector<WallPoint>& wall);

}  // namespace vicon::steps
