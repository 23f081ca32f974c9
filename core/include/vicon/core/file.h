#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace vicon {

/// Writes a file so that a crash leaves the old file or the new one: `write` fills a temporary name in the same folder,
/// which is then flushed to disk, given the mode of fileModeIn(), and renamed to `target`; the folder is flushed too.
/// The temporary name keeps the target's extension and starts with kTemporaryPrefix. When `write` throws, it is
/// removed.
void replaceFile(const std::filesystem::path& target, const std::function<void(const std::filesystem::path&)>& write);
void replaceFile(const std::filesystem::path& target, std::string_view content);

inline constexpr std::string_view kTemporaryPrefix = ".vicon-tmp-";

/// Flushes a file or a folder. Returns 0, else the system's number for what went wrong.
int flushToDisk(const std::filesystem::path& path);
/// Removes temporaries that a killed process left directly in `folder`. Call only while nobody else writes there.
void removeTemporaries(const std::filesystem::path& folder);

/// Creates a folder and what leads to it, each by makeFolder(), and flushes its parent.
void makePrivateFolder(const std::filesystem::path& folder);

/// The whole file. Throws Error{not_found} or Error{store}.
std::string readFile(const std::filesystem::path& file);

/// SHA-256 in lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);
std::string sha256OfFile(const std::filesystem::path& file);

/// Now in UTC as "2026-11-21T08:15:30Z".
std::string nowUtc();

}  // namespace vicon
