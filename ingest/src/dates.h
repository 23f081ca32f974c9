#pragma once

#include <chrono>
#include <string>

namespace vicon::ingest {

/// The day that DICOM writes YYYYMMDD; 1970-01-01 for what is none.
std::chrono::sys_days dayOf(const std::string& date);
/// As DICOM writes it.
std::string dateOf(std::chrono::sys_days day);

}  // namespace vicon::ingest
