#pragma once

#include <string>

namespace vicon::ingest {

/// How the name begins under which an object lies in the incoming folder and in quarantine, so that it is found by its
/// UID without being read: 32 digits.
std::string keptNameOf(const std::string& sop_uid);

/// That beginning of a file's name; empty where it has none.
std::string keptNameIn(const std::string& file_name);

}  // namespace vicon::ingest
