#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace vicon::support {

/// A folder that is gone when the object is.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

/// Whether a long proof runs in full (the label `long`), instead of a sample of it.
bool inFull();

/// Looks again and again until a condition holds; false when it does not within a minute.
bool waitUntil(const std::function<bool()>& holds);

/// A place in the outside test data; see VICON_NEEDS_DATA.
std::filesystem::path sharedData(const std::filesystem::path& name);

/// What a command printed (stdout and stderr together) and how it ended.
struct CommandResult {
    int exit_code = -1;
    std::string output;
};
CommandResult runCommand(const std::string& shell_line);
/// The built `vicon`.
std::string viconBinary();
/// Runs the built `vicon` with these arguments.
CommandResult runVicon(const std::string& arguments);

/// What is wrong with JSON files by docs/dev/schemas/SCHEMA.schema.json, a line each; empty where nothing is. The judge
/// is a validator that is not ours. That there are none is a fault.
std::string schemaFaults(const std::string& schema, const std::vector<std::filesystem::path>& files);
/// The files NAME.json of a folder.
std::vector<std::filesystem::path> jsonFilesIn(const std::filesystem::path& folder);

}  // namespace vicon::support

/// Skips the test, saying so, where the outside data is absent.
#define VICON_NEEDS_DATA(name)                                      \
    if (!std::filesystem::exists(vicon::support::sharedData(name))) \
    GTEST_SKIP() << "needs ../shared/data/" << (name)
