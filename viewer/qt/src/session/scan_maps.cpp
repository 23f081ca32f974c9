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
    const Version first{from.record.id, from.made}, second{to.record.id, to.made};
    if (second < first)
        return between(to, from).reversed();
    const std::lock_guard lock(mutex_);
    const auto known = maps_.find({first, second});
    if (known != maps_.end())
        return known->second;
    return maps_.emplace(std::pair(first, second), matchStations(profileOf(from), profileOf(to))).first->second;
}

}  // namespace vicon::viewer
