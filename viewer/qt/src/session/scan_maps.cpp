#include "session/scan_maps.h"

namespace vicon::viewer {
namespace {

ColonProfile profileOf(const OpenScan& scan, const Progress* wanted)
{
    ColonProfile profile = profileOf(scan.files.skeleton(), scan.files.parts(), scan.files.along());
    profile.relief = reliefOf(scan.files.inside(), scan.files.skeleton(), wanted);
    return profile;
}

}  // namespace

StationMap ScanMaps::between(const OpenScan& from, const OpenScan& to, const Progress* wanted)
{
    const Versions versions{{from.record.id, from.made}, {to.record.id, to.made}};
    if (versions.second < versions.first)
        return between(to, from, wanted).reversed();
    if (const auto made = known(versions))
        return *made;
    // The window need not wait for another pair's.
    StationMap map = matchStations(profileOf(from, wanted), profileOf(to, wanted), wanted);
    const std::lock_guard lock(mutex_);
    return maps_.insert_or_assign(versions, std::move(map)).first->second;
}

void ScanMaps::prepare(const std::shared_ptr<const OpenScan>& read, const Progress& wanted)
{
    for (const auto& other : heldBeside(read))
        if (other->record.id != read->record.id && haveSamePlaces(*other, *read))
            between(*other, *read, &wanted);
}

std::vector<std::shared_ptr<const OpenScan>> ScanMaps::heldBeside(const std::shared_ptr<const OpenScan>& read)
{
    const std::lock_guard lock(mutex_);
    std::vector<std::shared_ptr<const OpenScan>> held;
    std::erase_if(read_, [](const std::weak_ptr<const OpenScan>& one) { return one.expired(); });
    for (const auto& one : read_)
        if (auto other = one.lock())
            held.push_back(std::move(other));
    read_.push_back(read);
    return held;
}

std::optional<StationMap> ScanMaps::known(const Versions& versions)
{
    const std::lock_guard lock(mutex_);
    const auto at = maps_.find(versions);
    return at != maps_.end() ? std::optional(at->second) : std::nullopt;
}

}  // namespace vicon::viewer
