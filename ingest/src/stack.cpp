#include "stack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

namespace vicon::ingest {
namespace {

/// Directions of one stack differ by rounding only: 0.1 degrees.
constexpr double kSameDirection = 1 - 1.5e-6;
/// Pixel sizes of one stack differ by rounding only.
constexpr double kSameSpacing = 1e-3;
/// Two images closer than this lie in one place. Positions have three decimals; the thinnest CT slices are 0.2 mm
/// apart.
constexpr double kSamePlace_mm = 0.01;

/// An image was sent two or three times. More at one place are no copies, and comparing each with each takes long.
constexpr std::size_t kMostCopies = 8;

bool sameGrid(const SliceRef& a, const SliceRef& b)
{
    const PixelFormat &p = a.object->pixels, &q = b.object->pixels;
    const Slice &s = *a.slice, &t = *b.slice;
    return p.rows == q.rows && p.columns == q.columns && dot(s.row, t.row) > kSameDirection &&
           dot(s.column, t.column) > kSameDirection && std::abs(s.pixel_mm / t.pixel_mm - 1) < kSameSpacing &&
           std::abs(s.row_mm / t.row_mm - 1) < kSameSpacing;
}

std::string gridName(const SliceRef& ref)
{
    const Slice& s = *ref.slice;
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "%dx%d %.3f %.3f (%.2f %.2f %.2f) (%.2f %.2f %.2f)",
                  ref.object->pixels.columns, ref.object->pixels.rows, s.pixel_mm, s.row_mm, s.row.x, s.row.y, s.row.z,
                  s.column.x, s.column.y, s.column.z);
    return text.data();
}

bool before(const SliceRef& a, const SliceRef& b)
{
    return std::tie(a.object->sop_uid, a.slice->frame) < std::tie(b.object->sop_uid, b.slice->frame);
}

void sortAlongNormal(Stack& stack)
{
    const Vector3 normal = stack.normal();
    for (SliceRef& ref : stack.slices)
        ref.along_mm = dot(ref.slice->position_mm - Point3{}, normal);
    std::sort(stack.slices.begin(), stack.slices.end(), [](const SliceRef& a, const SliceRef& b) {
        return a.along_mm != b.along_mm ? a.along_mm < b.along_mm : before(a, b);
    });
}

/// The runs of slices at one place, as [first, last) indices; every slice belongs to one.
std::vector<std::pair<std::size_t, std::size_t>> places(const Stack& stack)
{
    std::vector<std::pair<std::size_t, std::size_t>> runs;
    for (std::size_t n = 0; n < stack.slices.size(); ++n) {
        if (n > 0 && stack.slices[n].along_mm - stack.slices[n - 1].along_mm < kSamePlace_mm)
            runs.back().second = n + 1;
        else
            runs.emplace_back(n, n + 1);
    }
    return runs;
}

std::size_t mostAtOnePlace(const Stack& stack)
{
    std::size_t most = 0;
    for (const auto& [first, last] : places(stack))
        most = std::max(most, last - first);
    return most;
}

/// What may tell images at one place apart. Of different takes there are as many as images at a place; where there
/// are more, it is a scan taken in steps and not several scans.
struct Distinction {
    const char* name;   ///< part of a scan's id: it stays as it is
    const char* words;  ///< for people
    std::string (*of)(const SliceRef&);
    bool different_takes;
    /// When images that share no place are told apart too: never, when they alternate, or always.
    enum class Apart { never, alternating, always } apart = Apart::never;
};
const std::array kDistinctions{
    Distinction{"lossy", "lossy compression",
                [](const SliceRef& r) { return r.object->series.lossy ? r.object->transfer_syntax : ""; }, false,
                Distinction::Apart::never},
    Distinction{"position", "patient position", [](const SliceRef& r) { return r.object->series.patient_position; },
                false, Distinction::Apart::always},
    Distinction{"image type", "image type", [](const SliceRef& r) { return r.slice->image_type; }, false,
                Distinction::Apart::alternating},
    Distinction{"kernel", "kernel", [](const SliceRef& r) { return r.slice->kernel; }, true,
                Distinction::Apart::always},
    Distinction{"acquisition", "acquisition number", [](const SliceRef& r) { return r.slice->acquisition; }, true,
                Distinction::Apart::alternating},
    Distinction{"time", "acquisition time", [](const SliceRef& r) { return r.object->acquisition_time; }, true,
                Distinction::Apart::alternating},
    Distinction{"phase", "phase", [](const SliceRef& r) { return r.slice->phase; }, true},
};

std::map<std::string, Stack> partition(const Stack& stack, const Distinction& distinction)
{
    std::map<std::string, Stack> parts;
    for (const SliceRef& ref : stack.slices) {
        Stack& part = parts[distinction.of(ref)];
        part.slices.push_back(ref);
    }
    for (auto& [value, part] : parts) {
        part.key = stack.key + "|" + distinction.name + " " + value;
        part.told_apart = stack.told_apart;
        part.told_apart.push_back(std::string(distinction.words) + " " + (value.empty() ? "none" : value));
    }
    return parts;
}

/// Drops images that repeat another one at their place; refuses the stack when different ones remain.
void dropCopies(Stack& stack, std::size_t most_at_one_place, const SamePixels& same_pixels)
{
    if (most_at_one_place > kMostCopies) {
        stack.refused = "no volume: up to " + std::to_string(most_at_one_place) + " images at one place";
        return;
    }
    std::vector<SliceRef> kept, copies;
    std::size_t crowded = 0, most = 0;
    double first_crowded_mm = 0;
    for (const auto& [first, last] : places(stack)) {
        const std::size_t begin = kept.size();
        for (std::size_t n = first; n < last; ++n) {
            const SliceRef& ref = stack.slices[n];
            const bool copy = std::any_of(kept.begin() + std::ptrdiff_t(begin), kept.end(),
                                          [&](const SliceRef& other) { return same_pixels(ref, other); });
            (copy ? copies : kept).push_back(ref);
        }
        if (kept.size() - begin > 1 && ++crowded == 1)
            first_crowded_mm = stack.slices[first].along_mm;
        most = std::max(most, kept.size() - begin);
    }
    if (crowded > 0) {
        stack.refused = "no volume: up to " + std::to_string(most) + " different images at one place (" +
                        (crowded == 1 ? "" : std::to_string(crowded) + " places, the first ") + "at " +
                        placeName(stack, first_crowded_mm) + ")";
        return;
    }
    if (!copies.empty())
        stack.repairs.push_back(std::to_string(copies.size()) +
                                " images repeat another one with the same pixels; one of each is used");
    stack.slices = std::move(kept);
    stack.copies = std::move(copies);
}

/// Whether images of different kinds lie between each other along the normal, more than once. A scan that was taken in
/// steps has many kinds, one after the other.
bool alternates(const Stack& stack, const Distinction& distinction, std::size_t kinds)
{
    constexpr std::size_t kMostTakes = 4;
    if (kinds > kMostTakes)
        return false;
    std::size_t runs = 0;
    for (std::size_t n = 0; n < stack.slices.size(); ++n)
        runs += n == 0 || distinction.of(stack.slices[n]) != distinction.of(stack.slices[n - 1]) ? 1 : 0;
    return runs > kinds + 1;
}

bool tellsApart(const Stack& stack, const Distinction& distinction, std::size_t kinds, std::size_t most)
{
    using Apart = Distinction::Apart;
    if (kinds < 2)
        return false;
    if (distinction.apart == Apart::always ||
        (distinction.apart == Apart::alternating && alternates(stack, distinction, kinds)))
        return true;
    if (most < 2)
        return false;
    const bool one_place = places(stack).size() == 1;
    return !distinction.different_takes || (!one_place && kinds <= most);
}

void resolve(Stack stack, std::size_t level, const SamePixels& same_pixels, std::vector<Stack>& out)
{
    sortAlongNormal(stack);
    const std::size_t most = mostAtOnePlace(stack);
    for (; level < kDistinctions.size(); ++level) {
        auto parts = partition(stack, kDistinctions[level]);
        if (!tellsApart(stack, kDistinctions[level], parts.size(), most))
            continue;
        for (auto& [value, part] : parts)
            resolve(std::move(part), level + 1, same_pixels, out);
        return;
    }
    if (most > 1)
        dropCopies(stack, most, same_pixels);
    out.push_back(std::move(stack));
}

std::vector<SliceRef> allSlices(const std::vector<const ImageObject*>& objects)
{
    std::vector<SliceRef> all;
    for (const ImageObject* object : objects)
        for (const Slice& slice : object->slices)
            all.push_back({object, &slice, 0});
    std::sort(all.begin(), all.end(), before);
    return all;
}

}  // namespace

std::vector<Stack> splitSeries(const std::vector<const ImageObject*>& objects, const SamePixels& same_pixels)
{
    std::vector<Stack> grids;
    for (const SliceRef& ref : allSlices(objects)) {
        const auto same = std::find_if(grids.begin(), grids.end(),
                                       [&](const Stack& stack) { return sameGrid(stack.slices.front(), ref); });
        if (same != grids.end())
            same->slices.push_back(ref);
        else
            grids.push_back({gridName(ref), {}, {ref}, {}, {}, {}});
    }
    std::vector<Stack> stacks;
    if (grids.size() > 1)
        for (Stack& grid : grids)
            grid.told_apart.push_back("matrix, pixel size and orientation " + grid.key);
    for (Stack& grid : grids)
        resolve(std::move(grid), 0, same_pixels, stacks);
    std::sort(stacks.begin(), stacks.end(), [](const Stack& a, const Stack& b) {
        return a.slices.size() != b.slices.size() ? a.slices.size() > b.slices.size() : a.key < b.key;
    });
    if (!stacks.empty())
        stacks.front().key.clear();
    return stacks;
}

std::string placeName(const Stack& stack, double along_mm)
{
    const Vector3 n = stack.normal();
    const std::array<double, 3> parts{n.x, n.y, n.z};
    const auto largest =
        std::max_element(parts.begin(), parts.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    // Where the line through the first slice's corner, along the normal, reaches that plane.
    const SliceRef& first = stack.slices.front();
    const double from_mm = dot(first.slice->position_mm - Point3{}, n);
    const Point3 p = first.slice->position_mm + n * (along_mm - from_mm);
    const std::array<double, 3> place{p.x, p.y, p.z};
    const auto axis = std::size_t(largest - parts.begin());
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%c = %.1f mm", "xyz"[axis], place[axis]);
    return text.data();
}

}  // namespace vicon::ingest
