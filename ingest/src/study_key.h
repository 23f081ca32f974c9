#pragma once

#include <filesystem>
#include <string>

namespace vicon::ingest {

/// What groups received objects by study before anybody parses them: the first Study Instance UID in the beginning of
/// the file, found by its bytes alone. Empty when there is none. Only what waits together depends on it.
std::string studyKeyOf(const std::filesystem::path& file);

}  // namespace vicon::ingest
