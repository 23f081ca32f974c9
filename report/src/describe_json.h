#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vicon::report {

/// A number of an object, 0 when it is not there or no number.
double numberAt(const nlohmann::json& object, const char* key);
/// A text of an object, empty when it is not there or no text.
std::string textAt(const nlohmann::json& object, const char* key);

/// What ingest noted, as lines: texts as they are; objects by their "why", equal ones counted; of many the first few
/// and how many more there are.
std::vector<std::string> describeNotes(const nlohmann::json& notes);

std::string joinedLines(const std::vector<std::string>& lines);

}  // namespace vicon::report
