#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vicon/viewer/qt/reading_room.h"

namespace vicon::viewer::test {

inline constexpr const char* kCase = "c1";
inline constexpr const char* kSupine = "s1";
inline constexpr const char* kProne = "s2";
inline constexpr const char* kFailedCase = "c2";

/// A store with one case of two scans that can be read, a colon of closed form, and one case without any.
void makeStore(const std::filesystem::path& folder);

/// What this reader has seen of a scan's wall, of all of it.
struct SeenWall {
    double seen_mm2 = 0, whole_mm2 = 0;
};
/// Keeps, as an earlier session does, that this reader has reviewed all of a scan but the wall within 12 mm of one
/// place at each of these stations.
SeenWall reviewAllBut(const std::filesystem::path& store, const char* scan, const std::vector<double>& stations_mm);

/// Says in a scan's folder which organ it shows.
void sayOrgan(const std::filesystem::path& scan_folder, const std::string& organ);

/// What `app` gives, on such a store: the second case counts as failed until it is retried.
ReadingServices servicesFor(const std::filesystem::path& folder);

}  // namespace vicon::viewer::test
