#include "vicon/viewer/model/missed_regions.h"

#include <algorithm>

namespace vicon::viewer {
namespace {

constexpr double kDone = 0.8;  // of the area; the rest is the edge, seen at a slant from everywhere

double reviewedOf(const UnseenPatch& patch, const Coverage& coverage)
{
    double area = 0;
    for (const std::uint32_t t : patch.triangles)
        area += coverage.seen(t) ? coverage.area_mm2(t) : 0;
    return area;
}

bool shareWall(const UnseenPatch& a, const UnseenPatch& b)
{
    return std::any_of(a.triangles.begin(), a.triangles.end(),
                       [&](std::uint32_t t) { return std::binary_search(b.triangles.begin(), b.triangles.end(), t); });
}

}  // namespace

MissedRegions::MissedRegions(std::vector<UnseenPatch> patches)
    : regions_(std::move(patches)), done_(regions_.size(), false), looked_at_(regions_.size(), false)
{
    std::stable_sort(regions_.begin(), regions_.end(),
                     [](const UnseenPatch& a, const UnseenPatch& b) { return a.station_mm < b.station_mm; });
}

void MissedRegions::visit(std::size_t region)
{
    visited_ = region;
    looked_at_[region] = true;
}

MissedRegions MissedRegions::listedAnew(std::vector<UnseenPatch> patches) const
{
    MissedRegions anew(std::move(patches));
    std::vector<UnseenPatch> looked_at = looked_at_before_;
    for (std::size_t n = 0; n < regions_.size(); ++n)
        if (looked_at_[n])
            looked_at.push_back(regions_[n]);
    for (const UnseenPatch& before : looked_at) {
        bool still_missed = false;
        for (std::size_t n = 0; n < anew.regions_.size(); ++n)
            if (shareWall(before, anew.regions_[n]))
                still_missed = anew.looked_at_[n] = true;
        if (!still_missed)
            anew.looked_at_before_.push_back(before);
    }
    return anew;
}

std::size_t MissedRegions::countLookedAt() const
{
    return looked_at_before_.size() + std::size_t(std::count(looked_at_.begin(), looked_at_.end(), true));
}

std::size_t MissedRegions::countDone() const
{
    return std::size_t(std::count(done_.begin(), done_.end(), true));
}

bool MissedRegions::tick(const Coverage& coverage)
{
    bool ticked = false;
    for (std::size_t n = 0; n < regions_.size(); ++n)
        if (!done_[n] && reviewedOf(regions_[n], coverage) >= kDone * regions_[n].area_mm2) {
            done_[n] = true;
            ticked = true;
        }
    return ticked;
}

std::optional<std::size_t> MissedRegions::next() const
{
    const std::size_t first = visited_ ? *visited_ + 1 : 0;
    for (std::size_t n = 0; n < regions_.size(); ++n)
        if (const std::size_t at = (first + n) % regions_.size(); !done_[at])
            return at;
    return std::nullopt;
}

std::vector<std::uint8_t> MissedRegions::trianglesOf(std::size_t region, std::size_t triangle_count) const
{
    std::vector<std::uint8_t> flags(triangle_count, 0);
    for (const std::uint32_t t : regions_[region].triangles)
        if (t < triangle_count)
            flags[t] = 1;
    return flags;
}

}  // namespace vicon::viewer
