#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "vicon/ingest/import.h"

namespace vicon::ingest {

struct InputFile {
    std::filesystem::path path;
    std::string shown;      ///< how the user knows it: the path, or "study.zip: folder/IM1"
    bool unpacked = false;  ///< comes out of a zip file
};

/// A folder in the store for what zip files hold; gone when the object is.
class UnpackFolder {
public:
    /// Throws Error{store}.
    explicit UnpackFolder(const std::filesystem::path& incoming);
    ~UnpackFolder();
    UnpackFolder(const UnpackFolder&) = delete;
    UnpackFolder& operator=(const UnpackFolder&) = delete;
    /// A name in the folder that was not used yet.
    std::filesystem::path nextFile();
    /// Of the archives of the import so far: their own, and of what came out of them.
    struct Bytes {
        double packed = 0, unpacked = 0;
    };
    Bytes& bytes() { return bytes_; }
    /// Removes what killed imports left. Call only while the store is locked: a folder that is being made looks like
    /// one that nobody has.
    static void removeLeftovers(const std::filesystem::path& incoming);

private:
    std::filesystem::path folder_;
    int descriptor_ = -1;  ///< locked while the import lives
    int count_ = 0;
    Bytes bytes_;
};

/// Lists the files below the given paths: folders recursively in order of name, DICOMDIRs by what they name. What
/// cannot be listed gets a line. Throws Error{not_found} when a given path does not exist.
std::vector<InputFile> listFiles(const std::vector<std::filesystem::path>& paths, std::vector<ImportLine>& lines);

/// Unpacks the files of a zip file. The names in it are only shown, never used as paths. What is no plain file, is
/// encrypted, or is named as if it should land elsewhere gets a line; so does an archive that is damaged or too large.
std::vector<InputFile> unpackZip(const InputFile& zip, UnpackFolder& folder, const ImportOptions& options,
                                 Progress& progress, std::vector<ImportLine>& lines);

}  // namespace vicon::ingest
