#pragma once

#include <filesystem>
#include <string>

#include "vicon/viewer/qt/reading_room.h"

namespace vicon::viewer::test {

inline constexpr const char* kCase = "c1";
inline constexpr const char* kSupine = "s1";
inline constexpr const char* kProne = "s2";
inline constexpr const char* kFailedCase = "c2";

/// A store with one case of two scans that can be read, a colon of closed form, and one case without any.
void makeStore(const std::filesystem::path& folder);

/// Says in a scan's folder which organ it shows.
void sayOrgan(const std::filesystem::path& scan_folder, const std::string& organ);

/// What `app` gives, on such a store: the second case counts as failed until it is retried.
ReadingServices servicesFor(const std::filesystem::path& folder);

}  // namespace vicon::viewer::test
