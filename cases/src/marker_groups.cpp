#include "vicon/cases/marker_groups.h"

#include <algorithm>
#include <map>
#include <set>

#include "vicon/core/error.h"

namespace vicon {
namespace {

/// The marker, and those that it is paired with.
std::vector<Marker> groupOf(const std::vector<Marker>& markers, const Marker& marker)
{
    std::vector<Marker> group{marker};
    for (const Marker& other : markers)
        if (other.id != marker.id && std::count(marker.partners.begin(), marker.partners.end(), other.id))
            group.push_back(other);
    return group;
}

/// Not the marker itself.
void dropThoseOf(const std::string& scan_id, std::vector<Marker>& group)
{
    group.erase(std::remove_if(group.begin() + 1, group.end(),
                               [&](const Marker& partner) { return partner.scan_id == scan_id; }),
                group.end());
}

}  // namespace

bool mayBeOneFinding(const std::vector<Marker>& markers, const Marker& a, const Marker& b)
{
    std::set<std::string> scans;
    for (const Marker& one : {a, b})
        for (const Marker& marker : groupOf(markers, one))
            if (!scans.insert(marker.scan_id).second)
                return false;
    return true;
}

std::vector<MarkerEdit> pairingEdits(const std::vector<Marker>& markers, const Marker& a, const Marker& b)
{
    if (a.scan_id == b.scan_id)
        throw Error(ErrorCode::wrong_use, "a pair is one finding in two scans; both markers lie in the same one",
                    a.id + " and " + b.id);
    std::vector<Marker> group = groupOf(markers, a), others = groupOf(markers, b);
    dropThoseOf(b.scan_id, group);
    dropThoseOf(a.scan_id, others);
    std::map<std::string, std::string> in_scan;
    for (const Marker& marker : group)
        in_scan[marker.scan_id] = marker.id;
    for (const Marker& marker : others) {
        const auto [there, is_new] = in_scan.emplace(marker.scan_id, marker.id);
        if (!is_new && there->second != marker.id)
            throw Error(ErrorCode::wrong_use, "both are paired in a third scan, each with another marker",
                        there->second + " and " + marker.id, "part one of the two first");
        if (is_new)
            group.push_back(marker);
    }
    const auto place = [&](const Marker& marker) {
        return std::find_if(markers.begin(), markers.end(), [&](const Marker& m) { return m.id == marker.id; });
    };
    std::sort(group.begin(), group.end(), [&](const Marker& x, const Marker& y) { return place(x) < place(y); });
    std::vector<MarkerEdit> edits;
    for (const Marker& marker : group) {
        Marker named = marker;
        named.partners.clear();
        for (const Marker& other : group)
            if (other.id != marker.id)
                named.partners.push_back(other.id);
        edits.push_back({marker, named});
    }
    return edits;
}

}  // namespace vicon
