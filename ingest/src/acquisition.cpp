#include "acquisition.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>

namespace vicon::ingest {
namespace {

/// Reconstructions of one acquisition give its times within this; two acquisitions are a breath-hold or more apart.
constexpr double kSameTake_s = 5;
/// A reconstruction that covers less of the patient than this part of the longest one is not the scan.
constexpr double kFullCoverage = 0.8;
/// Siemens numbers kernels by sharpness: B30f, Br36, I40 are soft; from 50 on for bone and lung.
constexpr int kSiemensSharpFrom = 50;
/// Canon/Toshiba: FC01 to FC19 body, FC30 and more bone, lung and inner ear.
constexpr int kCanonSharpFrom = 20;

/// Seconds since midnight of "YYYYMMDDHHMMSS.F..."; nothing when it is shorter. Days count as 24 h.
std::optional<double> secondsOf(const std::string& date_time)
{
    constexpr std::size_t kWithoutFraction = 14;
    if (date_time.size() < kWithoutFraction || !std::all_of(date_time.begin(), date_time.begin() + kWithoutFraction,
                                                            [](char c) { return c >= '0' && c <= '9'; }))
        return {};
    const auto part = [&](std::size_t from) { return std::stod(date_time.substr(from, 2)); };
    const double day = std::stod(date_time.substr(0, 8));
    return day * 86400 + part(8) * 3600 + part(10) * 60 + part(12);
}

std::optional<int> twoDigitsAt(const std::string& text, std::size_t from)
{
    const auto digit = [&](std::size_t n) { return n < text.size() && text[n] >= '0' && text[n] <= '9'; };
    if (!digit(from) || !digit(from + 1))
        return {};
    return (text[from] - '0') * 10 + (text[from + 1] - '0');
}

struct Take {
    std::string position, frame_of_reference, uid;
    std::set<std::string> numbers;
    std::optional<std::pair<double, double>> time;
};

Take takeOf(const Reconstruction& reconstruction)
{
    const ImageObject& first = *reconstruction.stack->slices.front().object;
    Take take{first.series.patient_position, first.series.frame_of_reference_uid, first.acquisition_uid, {}, {}};
    for (const SliceRef& ref : reconstruction.stack->slices) {
        if (!ref.slice->acquisition.empty())
            take.numbers.insert(ref.slice->acquisition);
        if (const auto seconds = secondsOf(ref.object->acquisition_time)) {
            const auto known = take.time.value_or(std::pair(*seconds, *seconds));
            take.time = {std::min(known.first, *seconds), std::max(known.second, *seconds)};
        }
    }
    return take;
}

bool sameTake(const Take& a, const Take& b)
{
    if (a.position != b.position)
        return false;
    if (!a.uid.empty() && !b.uid.empty())
        return a.uid == b.uid;
    if (a.frame_of_reference != b.frame_of_reference)
        return false;
    const bool both_numbers = !a.numbers.empty() && !b.numbers.empty();
    if (both_numbers && std::none_of(a.numbers.begin(), a.numbers.end(),
                                     [&](const std::string& number) { return b.numbers.contains(number); }))
        return false;
    if (a.time && b.time)
        return a.time->first <= b.time->second + kSameTake_s && b.time->first <= a.time->second + kSameTake_s;
    return both_numbers || !a.frame_of_reference.empty();
}

bool isReformat(const Stack& stack)
{
    const std::string& type = stack.slices.front().slice->image_type;
    for (const char* word : {"MPR", "MIP", "MINIP", "REFORMATTED", "PROJECTION", "VOLREN", "AVERAGE"})
        if (type.find(word) != std::string::npos)
            return true;
    constexpr double kAxial = 0.7;  // 45 degrees
    return std::abs(stack.normal().z) < kAxial;
}

double extentOf(const Reconstruction& r)
{
    return r.plan->grid.spacing_mm[2] * r.plan->grid.size[2];
}

auto rankOf(const Reconstruction& r, double longest_mm)
{
    const ImageObject& object = *r.stack->slices.front().object;
    const double thickness_mm = r.stack->slices.front().slice->thickness_mm;
    const double spacing_mm = r.plan->grid.spacing_mm[2];
    return std::tuple(isReformat(*r.stack), extentOf(r) < kFullCoverage * longest_mm,
                      int(sharpnessOf(object.series.kernel)), thickness_mm > 0 ? thickness_mm : spacing_mm, spacing_mm,
                      object.series.lossy, -r.plan->grid.size[2], object.series.number, object.series.uid,
                      r.stack->key);
}

}  // namespace

Sharpness sharpnessOf(const std::string& kernel)
{
    std::string name = kernel;
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    if (const auto number = name.starts_with("FC") ? twoDigitsAt(name, 2) : std::nullopt)
        return *number < kCanonSharpFrom ? Sharpness::soft : Sharpness::sharp;
    if (std::string_view("BHQUIJT").find(name.substr(0, 1)) != std::string_view::npos && !name.empty())
        for (const std::size_t letters : {1, 2})  // B30F, BR36
            if (const auto number = twoDigitsAt(name, letters))
                return *number < kSiemensSharpFrom ? Sharpness::soft : Sharpness::sharp;
    for (const char* soft : {"SOFT", "STANDARD", "STND", "SMOOTH", "BODY"})
        if (name.starts_with(soft))
            return Sharpness::soft;
    for (const char* sharp : {"LUNG", "BONE", "EDGE", "ULTRA", "SHARP"})
        if (name.starts_with(sharp))
            return Sharpness::sharp;
    if (name == "A" || name == "B" || name == "SA" || name == "SB")  // Philips
        return Sharpness::soft;
    if (name == "D" || name == "E" || name == "L" || name == "YC" || name == "YD")
        return Sharpness::sharp;
    return Sharpness::unknown;
}

std::vector<std::size_t> chooseScans(const std::vector<Reconstruction>& reconstructions)
{
    std::vector<Take> takes;
    for (const Reconstruction& r : reconstructions)
        takes.push_back(takeOf(r));
    std::vector<std::size_t> group(reconstructions.size());
    std::iota(group.begin(), group.end(), std::size_t(0));
    for (std::size_t a = 0; a < group.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (group[a] != group[b] && sameTake(takes[a], takes[b]))
                std::replace(group.begin(), group.end(), group[a], group[b]);
    std::vector<std::size_t> chosen(group.size());
    for (std::size_t n = 0; n < group.size(); ++n) {
        double longest_mm = 0;
        for (std::size_t m = 0; m < group.size(); ++m)
            if (group[m] == group[n])
                longest_mm = std::max(longest_mm, extentOf(reconstructions[m]));
        std::size_t best = n;
        for (std::size_t m = 0; m < group.size(); ++m)
            if (group[m] == group[n] &&
                rankOf(reconstructions[m], longest_mm) < rankOf(reconstructions[best], longest_mm))
                best = m;
        chosen[n] = best;
    }
    return chosen;
}

}  // namespace vicon::ingest
