#pragma once

#include <array>
#include <filesystem>
#include <string>

namespace vicon::test {

/// The encodings without loss that a series may come in: plain ones, then compressed ones.
inline constexpr std::array kEncodings{
    "1.2.840.10008.1.2",      "1.2.840.10008.1.2.1",    "1.2.840.10008.1.2.2",
    "1.2.840.10008.1.2.1.99", "1.2.840.10008.1.2.5",    "1.2.840.10008.1.2.4.57",
    "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.80", "1.2.840.10008.1.2.4.90",
};

/// Writes an object in another encoding, by DCMTK or GDCM. Throws std::runtime_error where that fails.
void transcode(const std::filesystem::path& from, const std::filesystem::path& to, const std::string& transfer_syntax);

}  // namespace vicon::test
