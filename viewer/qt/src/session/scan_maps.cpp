#include "session/scan_maps.h"

namespace vicon::viewer {
namespace {

ColonProfile profileOf(const OpenScan& scan)
{
    ColonProfile profile = profileOf(scan.files.skeleton(), scan.files.parts(), scan.files.along());
    profile.relief = reliefOf(scan.files.inside(), scan.files.skeleton());
    return profile;
}

}  // namespace

StationMap ScanMaps::between(const OpenScan& from, const OpenScan& to)
{
    const Versions versions{{from.record.id, from.made}, {to.record.id, to.made}};
    if (versions.second < versions.first)
        return between(to, from).reversed();
    if (const auto made = known(versions))
        return *made;
    StationMap map = matchStations(profileOf(from), profileOf(to));  // the window need not wait for another pair's
    const std::lock_guard lock(mutex_);
    return maps_.insert_or_assign(versions, std::move(map)).first->second;
}

std::optional<StationMap> ScanMaps::known(const Versions& versions)
{
    const std::lock_guard lock(mutex_);
    const auto at = maps_.find(versions);
    return at != maps_.end() ? std::optional(at->second) : std::nullopt;
}

}  // namespace vicon::viewer
