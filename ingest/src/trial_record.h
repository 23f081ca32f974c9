#pragma once

#include <filesystem>
#include <vector>

namespace vicon::ingest {

/// Files that are being taken, and how many processes died while they took exactly these.
struct Trial {
    std::vector<std::filesystem::path> files;
    int deaths = 0;
};

/// Stands in the folder while files are being taken, so that the next process knows what killed this one.
class TrialRecord {
public:
    /// Throws Error{store}.
    TrialRecord(const std::filesystem::path& folder, const Trial& trial);
    ~TrialRecord();
    TrialRecord(const TrialRecord&) = delete;
    TrialRecord& operator=(const TrialRecord&) = delete;

private:
    std::filesystem::path file_;
};

/// What a process that died was taking, its death counted; nothing when none died.
Trial readTrial(const std::filesystem::path& folder);

}  // namespace vicon::ingest
