#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "vicon/cases/case_store.h"
#include "vicon/core/progress.h"

namespace vicon::ingest {

/// What became of a case's objects.
struct Anonymised {
    int written = 0;
    std::map<std::string, int> left_out;  ///< why, and how many
};

/// Writes a case's CT images without who it is, by the Basic Application Level Confidentiality Profile of DICOM PS3.15:
/// only attributes that describe the picture are kept, private ones go, UIDs become others, the same for the same,
/// dates and times lie earlier by one span for each patient. Two patients are never one: ID, name and birth date tell
/// them apart, and a study that lacks one of these stands alone. Pixels are as they were; what may hold text in its
/// pixels is left out. The same case gives the same result again, as its store keeps a key. Throws Error{wrong_use}
/// where `out` is not empty; Error{bad_input}, Error{store}, Error{cancelled}: `out` is not there then.
Anonymised anonymise(CaseStore& store, const std::string& case_id, const std::filesystem::path& out,
                     Progress& progress);

}  // namespace vicon::ingest
