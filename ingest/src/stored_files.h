#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vicon/core/error.h"
#include "vicon/core/progress.h"

namespace vicon::ingest {

/// The name of an object's file in a scan's dicom folder: safe, stable, free of patient data.
std::string fileNameFor(const std::string& sop_uid);

struct FileCopy {
    std::filesystem::path from;
    std::string name;  ///< in the target folder
};

/// Copies files into a folder, byte for byte and durably: all under temporary names, each flushed, then all renamed,
/// then the folder flushed. What a killed import left there under temporary names is removed first.
/// Call only while no other import works on the store. Throws Error{store}.
void copyDurably(const std::filesystem::path& folder, const std::vector<FileCopy>& copies, Progress& progress);

/// What is told of a copy that failed with a number of the system: a full disk is the store's trouble, not the file's.
Error notCopied(const std::filesystem::path& from, const std::filesystem::path& to, int number);

}  // namespace vicon::ingest
