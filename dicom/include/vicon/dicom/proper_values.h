#pragma once

#include <string>

namespace vicon {

/// Whether a text is a UID as DICOM PS3.5 section 9.1 has it.
bool isUid(const std::string& text);

/// A UID as it is; one that stands for any other text, the same for the same text.
std::string properUid(const std::string& text);

/// A name or account as a person's name (PS3.5, PN): what would part values, groups or components is a space.
std::string properPersonName(const std::string& name);

}  // namespace vicon
