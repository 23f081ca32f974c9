#include "stack_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

namespace vicon::ingest {
namespace {

/// Below this sideways shift over the whole stack nothing is resampled: positions are rounded to 0.001 mm.
constexpr double kNoTiltPixels = 0.1;
/// Gantries tilt up to 30 degrees; a stack that leans further was not made by a gantry.
constexpr double kLargestTilt_deg = 45;
/// How far a slice may lie sideways of a straight, tilted stack.
constexpr double kSidewaysTolerance_mm = 0.5;
/// A spacing for a single slice that does not say its thickness: any value would do, it has no neighbour.
constexpr double kSingleSliceSpacing_mm = 1;

std::string mm(double value, int decimals = 2)
{
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.*f mm", decimals, value);
    return text.data();
}

/// Removes what only the writing of decimal numbers left, so that a volume stored in reverse gets the same grid.
double rounded(double value)
{
    constexpr double kSteps = 1e6;
    return std::round(value * kSteps) / kSteps;
}

std::vector<double> increments(const Stack& stack)
{
    std::vector<double> out;
    for (std::size_t n = 1; n < stack.slices.size(); ++n)
        out.push_back(stack.slices[n].along_mm - stack.slices[n - 1].along_mm);
    return out;
}

double medianOf(std::vector<double> values)
{
    const auto middle = values.begin() + std::ptrdiff_t((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Sets the grid's third size and spacing and the source of every plane.
class SlicePlanner {
public:
    SlicePlanner(const Stack& stack, const ImportOptions& options, StackPlan& plan)
        : stack_(stack), options_(options), plan_(plan)
    {
    }

    void plan()
    {
        if (stack_.slices.size() == 1)
            return planSingle();
        const std::vector<double> steps = increments(stack_);
        nominal_mm_ = medianOf(steps);
        findGaps(steps);
        if (!plan_.refused.empty())
            return;
        const double first_mm = stack_.slices.front().along_mm;
        const double extent_mm = stack_.slices.back().along_mm - first_mm;
        const int steps_count = std::max(1, int(std::lround(extent_mm / nominal_mm_)));
        plan_.grid.size[2] = steps_count + 1;
        plan_.grid.spacing_mm[2] = rounded(extent_mm / steps_count);
        for (int k = 0; k <= steps_count; ++k)
            plan_.planes.push_back(sourceAt(first_mm + extent_mm * k / steps_count));
        tellOfPlanes(steps);
    }

private:
    void planSingle()
    {
        const double thickness_mm = stack_.slices.front().slice->thickness_mm;
        plan_.grid.size[2] = 1;
        plan_.grid.spacing_mm[2] = thickness_mm > 0 ? thickness_mm : kSingleSliceSpacing_mm;
        plan_.planes.push_back({});
    }

    /// Lists the places where slices are missing, and refuses a gap that is too large.
    void findGaps(const std::vector<double>& steps)
    {
        nlohmann::json& missing = plan_.geometry["missing"] = nlohmann::json::array();
        std::vector<std::string> too_large;
        for (std::size_t n = 0; n < steps.size(); ++n) {
            const double absent_mm = steps[n] - nominal_mm_;
            const int slices = int(std::lround(steps[n] / nominal_mm_)) - 1;
            if (slices < 1)
                continue;
            missing_slices_ += std::size_t(slices);
            const double middle_mm = (stack_.slices[n].along_mm + stack_.slices[n + 1].along_mm) / 2;
            const std::string where = placeName(stack_, middle_mm);
            missing.push_back({{"at", where}, {"missing_mm", rounded(absent_mm)}, {"slices", slices}});
            const std::string what = std::to_string(slices) + (slices == 1 ? " slice" : " slices") + " missing at " +
                                     where + " (" + mm(absent_mm, 1) + " not measured)";
            if (absent_mm > options_.largest_missing_gap_mm)
                too_large.push_back(what);
            else
                plan_.repairs.push_back(what + "; interpolated between its neighbours");
        }
        if (too_large.empty())
            return;
        plan_.refused = too_large.front() + ", more than the " + mm(options_.largest_missing_gap_mm, 1) + " allowed";
        if (too_large.size() > 1)
            plan_.refused += "; and " + std::to_string(too_large.size() - 1) + " more such gaps";
    }

    PlaneSource sourceAt(double along_mm)
    {
        while (next_ + 1 < stack_.slices.size() && stack_.slices[next_ + 1].along_mm <= along_mm)
            ++next_;
        const std::size_t above = std::min(next_ + 1, stack_.slices.size() - 1);
        const double a = stack_.slices[next_].along_mm, b = stack_.slices[above].along_mm;
        if (along_mm - a <= options_.spacing_tolerance_mm && along_mm - a <= b - along_mm)
            return used(next_, along_mm - a);
        if (b - along_mm <= options_.spacing_tolerance_mm)
            return used(above, b - along_mm);
        return {next_, above, (along_mm - a) / (b - a)};
    }

    PlaneSource used(std::size_t slice, double off_mm)
    {
        largest_offset_mm_ = std::max(largest_offset_mm_, std::abs(off_mm));
        return {slice, slice, 0};
    }

    void tellOfPlanes(const std::vector<double>& steps)
    {
        std::size_t interpolated = 0;
        std::set<std::size_t> used;
        for (const PlaneSource& plane : plan_.planes) {
            interpolated += plane.interpolated() ? 1 : 0;
            used.insert({plane.below, plane.above});
        }
        if (const std::size_t unused = stack_.slices.size() - used.size(); unused > 0)
            plan_.repairs.push_back(std::to_string(unused) + " measured slices between the steps are not used");
        plan_.geometry["interpolated_slices"] = interpolated;
        plan_.geometry["largest_offset_mm"] = rounded(largest_offset_mm_);
        const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
        const std::string range = mm(*least) + " to " + mm(*most);
        const double part = double(interpolated) / double(plan_.planes.size());
        const bool too_many = part > options_.largest_interpolated_part;
        // A few missing slices of a short series are no sign of an uneven one.
        if (too_many && interpolated > missing_slices_)
            plan_.refused = "no even stack: its slices are " + range + " apart";
        else if (too_many && plan_.planes.size() >= std::size_t(options_.min_slices))
            plan_.refused = "too many slices are missing: " + std::to_string(missing_slices_) + " of " +
                            std::to_string(plan_.planes.size());
        else if (interpolated > missing_slices_)
            plan_.repairs.push_back("slices " + range + " apart; interpolated to even steps of " +
                                    mm(plan_.grid.spacing_mm[2]));
    }

    const Stack& stack_;
    const ImportOptions& options_;
    StackPlan& plan_;
    double nominal_mm_ = 0;
    std::size_t next_ = 0;
    std::size_t missing_slices_ = 0;
    double largest_offset_mm_ = 0;
};

/// Finds out how the stack leans and where each slice lies in the plane of the grid.
void planTilt(const Stack& stack, StackPlan& plan)
{
    const Slice& first = *stack.slices.front().slice;
    const Slice& last = *stack.slices.back().slice;
    const double extent_mm = stack.slices.back().along_mm - stack.slices.front().along_mm;
    const Vector3 lean = last.position_mm - first.position_mm - first.normal() * extent_mm;
    double largest_pixels = 0, largest_sideways_mm = 0;
    for (const SliceRef& ref : stack.slices) {
        const double up_mm = ref.along_mm - stack.slices.front().along_mm;
        const Vector3 aside = ref.slice->position_mm - first.position_mm - first.normal() * up_mm;
        const double part = extent_mm > 0 ? up_mm / extent_mm : 0;
        largest_sideways_mm = std::max(largest_sideways_mm, length(aside - lean * part));
        plan.shift_pixels.push_back({dot(aside, first.row) / first.pixel_mm, dot(aside, first.column) / first.row_mm});
        largest_pixels =
            std::max({largest_pixels, std::abs(plan.shift_pixels.back()[0]), std::abs(plan.shift_pixels.back()[1])});
    }
    const double tilt_deg = extent_mm > 0 ? std::atan2(length(lean), extent_mm) * 180 / std::numbers::pi : 0;
    if (largest_sideways_mm > kSidewaysTolerance_mm) {
        plan.refused = "no straight stack: slices lie up to " + mm(largest_sideways_mm) + " sideways";
        return;
    }
    if (tilt_deg > kLargestTilt_deg) {
        plan.refused = "no volume: the slices lie beside each other rather than above";
        return;
    }
    plan.tilted = largest_pixels > kNoTiltPixels;
    plan.geometry["tilt_deg"] = plan.tilted ? std::round(tilt_deg * 1000) / 1000 : 0;
    if (!plan.tilted) {
        std::fill(plan.shift_pixels.begin(), plan.shift_pixels.end(), std::array<double, 2>{0, 0});
        return;
    }
    std::array<char, 80> text{};
    std::snprintf(text.data(), text.size(), "gantry tilted by %.1f degrees; removed by resampling in the slices",
                  tilt_deg);
    plan.repairs.emplace_back(text.data());
}

/// Sets the grid within the plane so that it holds every slice, and its origin.
void placeGrid(const Stack& stack, StackPlan& plan)
{
    const Slice& first = *stack.slices.front().slice;
    Grid& grid = plan.grid;
    grid.axis = {first.row, first.column, first.normal()};
    grid.spacing_mm[0] = rounded(first.pixel_mm);
    grid.spacing_mm[1] = rounded(first.row_mm);
    const std::array<int, 2> matrix{stack.slices.front().object->pixels.columns,
                                    stack.slices.front().object->pixels.rows};
    grid.origin_mm = first.position_mm;
    for (std::size_t a = 0; a < 2; ++a) {
        double lowest = 0, highest = 0;
        for (const auto& shift : plan.shift_pixels) {
            lowest = std::min(lowest, shift[a]);
            highest = std::max(highest, shift[a]);
        }
        const double begin = std::floor(lowest);
        grid.size[a] = matrix[a] + int(std::ceil(highest) - begin);
        grid.origin_mm += grid.axis[a] * (begin * grid.spacing_mm[a]);
        for (auto& shift : plan.shift_pixels)
            shift[a] -= begin;
    }
    grid.origin_mm = {rounded(grid.origin_mm.x), rounded(grid.origin_mm.y), rounded(grid.origin_mm.z)};
}

}  // namespace

StackPlan planStack(const Stack& stack, const ImportOptions& options)
{
    StackPlan plan;
    plan.refused = stack.refused;
    plan.repairs = stack.repairs;
    if (plan.refused.empty())
        planTilt(stack, plan);
    if (plan.refused.empty())
        SlicePlanner(stack, options, plan).plan();
    if (!plan.refused.empty())
        return plan;
    placeGrid(stack, plan);
    constexpr double kMillion = 1e6;
    if (double(plan.grid.voxelCount()) > options.largest_volume_mvoxel * kMillion)
        plan.refused = "its volume would be larger than import.largest_volume_mvoxel allows";
    return plan;
}

NearestToPatient nearestToPatient(const Grid& grid)
{
    const auto component = [&](int axis, int along) {
        const Vector3& v = grid.axis[std::size_t(axis)];
        return along == 0 ? v.x : along == 1 ? v.y : v.z;
    };
    NearestToPatient best;
    double best_score = -10;
    std::array<int, 3> order{0, 1, 2};
    do {
        const bool even = (order[0] + 1) % 3 == order[1];  // of three, the cyclic orders are the even ones
        for (int signs = 0; signs < 8; ++signs) {
            const bool odd_flips = (signs & 1) ^ (signs >> 1 & 1) ^ (signs >> 2 & 1);
            if (even == odd_flips)
                continue;  // left-handed
            double score = 0;
            for (int a = 0; a < 3; ++a)
                score += component(order[std::size_t(a)], a) * ((signs >> a & 1) ? -1 : 1);
            constexpr double kClearlyBetter = 1e-9;
            if (score < best_score + kClearlyBetter)
                continue;
            best_score = score;
            for (std::size_t a = 0; a < 3; ++a) {
                best.from[a] = order[a];
                best.flipped[a] = (signs >> a & 1) != 0;
            }
        }
    } while (std::next_permutation(order.begin(), order.end()));
    best.grid.origin_mm = grid.origin_mm;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto old = std::size_t(best.from[a]);
        best.grid.size[a] = grid.size[old];
        best.grid.spacing_mm[a] = grid.spacing_mm[old];
        best.grid.axis[a] = best.flipped[a] ? Vector3{} - grid.axis[old] : grid.axis[old];  // no negative zeros
        if (best.flipped[a])
            best.grid.origin_mm += grid.axis[old] * (grid.spacing_mm[old] * (grid.size[old] - 1));
    }
    best.grid.origin_mm = {rounded(best.grid.origin_mm.x), rounded(best.grid.origin_mm.y),
                           rounded(best.grid.origin_mm.z)};
    return best;
}

}  // namespace vicon::ingest
