#include "mask/frame_stack.h"

#include <algorithm>
#include <cmath>

#include "mask/refusal.h"

namespace vicon::ingest {
namespace {

constexpr double kSamePlace_mm = 0.01;
/// Of a step: how far a frame may lie from its place in an even stack. Positions are those of the scanner's slices.
constexpr double kOffPlace = 0.25;
/// Of a pixel: how far it may lie aside. A leaning stack is no lattice of boxes.
constexpr double kAside_pixels = 0.25;
/// More than any lattice has, and still a whole number.
constexpr double kTooManySlices = 1e9;

Vector3 normalOf(const FramePlanes& planes)
{
    return normalized(cross(planes.column_step_mm, planes.row_step_mm));
}

/// Heights of all frames along the normal, from the lowest.
std::vector<double> heights_mm(const FramePlanes& planes)
{
    std::vector<double> heights;
    for (const SegmentFrame& frame : planes.frames)
        heights.push_back(dot(frame.first_mm - planes.frames.front().first_mm, normalOf(planes)));
    const double lowest = *std::min_element(heights.begin(), heights.end());
    for (double& height : heights)
        height -= lowest;
    return heights;
}

bool fits(const std::vector<double>& heights, double step_mm)
{
    return step_mm > 0 && std::all_of(heights.begin(), heights.end(), [&](double height) {
               return std::abs(height / step_mm - std::round(height / step_mm)) < kOffPlace;
           });
}

/// Frames without any of a segment may be missing, so the smallest gap is one step, or several.
double stepOf(std::vector<double> heights, double declared_mm, const std::filesystem::path& file)
{
    std::sort(heights.begin(), heights.end());
    double smallest_mm = 0;
    for (std::size_t n = 1; n < heights.size(); ++n)
        if (const double gap = heights[n] - heights[n - 1];
            gap > kSamePlace_mm && (smallest_mm == 0 || gap < smallest_mm))
            smallest_mm = gap;
    if (fits(heights, declared_mm))
        return declared_mm;
    if (smallest_mm > 0) {
        const double all_mm = heights.back(), steps = std::round(all_mm / smallest_mm);
        if (fits(heights, all_mm / steps))
            return all_mm / steps;
    }
    throw maskRefused(file, "its frames do not lie evenly, one step apart", "write it on the scan's own slices");
}

}  // namespace

FrameStack stackOf(const FramePlanes& planes, double largest_mvoxel, const std::filesystem::path& file)
{
    const std::vector<double> heights = heights_mm(planes);
    const double step_mm = stepOf(heights, planes.declared_step_mm, file);
    const auto lowest = std::size_t(std::min_element(heights.begin(), heights.end()) - heights.begin());
    const double highest_mm = *std::max_element(heights.begin(), heights.end());
    const auto last = std::int64_t(std::min(std::round(highest_mm / step_mm), kTooManySlices));
    FrameStack stack;
    stack.grid = latticeOf({.size = {planes.columns, planes.rows, last + 1},
                            .first_mm = planes.frames[lowest].first_mm,
                            .step_mm = {planes.column_step_mm, planes.row_step_mm, normalOf(planes) * step_mm}},
                           largest_mvoxel, file);
    for (std::size_t n = 0; n < heights.size(); ++n) {
        const ContinuousIndex3 at = stack.grid.continuousIndexAt(planes.frames[n].first_mm);
        if (!(std::abs(at.i) < kAside_pixels && std::abs(at.j) < kAside_pixels))
            throw maskRefused(file, "its frames do not lie straight above each other",
                              "resample the mask onto upright slices first");
        stack.slice.push_back(int(std::lround(heights[n] / step_mm)));
    }
    return stack;
}

}  // namespace vicon::ingest
