#pragma once

#include <filesystem>
#include <string>

namespace vicon::app {

/// A private folder for a report's files until they are kept, gone when the report is written. Those that killed
/// commands of this user left behind go when the next one is made.
class ReportFolder {
public:
    /// Throws Error{store}.
    ReportFolder();
    ~ReportFolder();
    ReportFolder(const ReportFolder&) = delete;
    ReportFolder& operator=(const ReportFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
    int lock_ = -1;  ///< a file of the folder, locked while it is used
};

}  // namespace vicon::app
