#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "session/open_scan.h"
#include "vicon/cases/station_map.h"

namespace vicon::viewer {

/// The stations of scans in one another. One map serves both directions, so that there and back is the same place.
/// From any thread.
class ScanMaps {
public:
    /// Of two scans of one patient. Takes half a second the first time: the loader asks before the window does. Throws
    /// Error{cancelled} where `wanted` is no longer.
    StationMap between(const OpenScan& from, const OpenScan& to, const Progress* wanted = nullptr);
    /// Those of a scan that was read and of all others that are still held, whether the window shows them yet or not.
    void prepare(const std::shared_ptr<const OpenScan>& read, const Progress& wanted);

private:
    std::vector<std::shared_ptr<const OpenScan>> heldBeside(const std::shared_ptr<const OpenScan>& read);

    /// A scan, and when its files were made.
    using Version = std::pair<std::string, std::filesystem::file_time_type>;
    using Versions = std::pair<Version, Version>;
    std::optional<StationMap> known(const Versions& versions);

    std::mutex mutex_;
    std::map<Versions, StationMap> maps_;
    std::vector<std::weak_ptr<const OpenScan>> read_;
};

}  // namespace vicon::viewer
