#include "vicon/support/support.h"

#include <sys/wait.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace fs = std::filesystem;

namespace vicon::support {

TemporaryFolder::TemporaryFolder()
{
    std::string name = (fs::temp_directory_path() / "vicon-test-XXXXXX").string();
    if (!::mkdtemp(name.data()))
        throw std::runtime_error("no temporary folder");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

bool inFull()
{
    return std::getenv("VICON_IN_FULL") != nullptr;
}

bool waitUntil(const std::function<bool()>& holds)
{
    constexpr std::chrono::minutes kLongest{1};
    constexpr std::chrono::milliseconds kFirst{1}, kMost{50};
    const auto end = std::chrono::steady_clock::now() + kLongest;
    for (auto between = kFirst; !holds(); between = std::min(2 * between, kMost)) {
        if (std::chrono::steady_clock::now() > end)
            return false;
        std::this_thread::sleep_for(between);
    }
    return true;
}

fs::path sharedData(const fs::path& name)
{
    return fs::path(VICON_SHARED_DATA) / name;
}

CommandResult runCommand(const std::string& shell_line)
{
    CommandResult result;
    FILE* pipe = ::popen((shell_line + " 2>&1").c_str(), "r");
    if (!pipe)
        return result;
    std::array<char, 4096> block;
    while (const auto count = std::fread(block.data(), 1, block.size(), pipe))
        result.output.append(block.data(), count);
    const int status = ::pclose(pipe);
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}

std::string viconBinary()
{
    return VICON_BINARY;
}

CommandResult runVicon(const std::string& arguments)
{
    return runCommand(viconBinary() + " " + arguments);
}

std::string schemaFaults(const std::string& schema, const std::vector<std::filesystem::path>& files)
{
    if (files.empty())
        return "no files";
    const auto schema_file = std::filesystem::path(VICON_SCHEMAS) / (schema + ".schema.json");
    std::string command = std::string(VICON_VALIDATE_JSON) + " '" + schema_file.string() + "'";
    for (const auto& file : files)
        command += " '" + file.string() + "'";
    const CommandResult result = runCommand(command);
    return result.exit_code == 0 ? "" : "exit code " + std::to_string(result.exit_code) + ": " + result.output;
}

std::vector<std::filesystem::path> jsonFilesIn(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".json")
            files.push_back(entry.path());
    return files;
}

}  // namespace vicon::support
