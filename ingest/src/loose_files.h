#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace vicon::ingest {

/// The files of a store that are in no case: those that wait for the import, and those in quarantine. Looked for once,
/// at the first question.
class LooseFiles {
public:
    explicit LooseFiles(std::filesystem::path store) : store_(std::move(store)) {}
    std::vector<std::filesystem::path> of(const std::string& sop_uid);

private:
    void look();

    std::filesystem::path store_;
    bool looked_ = false;
    std::multimap<std::string, std::filesystem::path> files_;  ///< by the beginning of their names
};

}  // namespace vicon::ingest
