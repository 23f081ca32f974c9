#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vicon::report {

/// A number of an object, 0 when it is not there or no number.
double numberAt(const nlohmann::json& object, const char* key);
/// A text of an object, empty when it is not there or no text.
std::string textAt(const nlohmann::json& object, const char* key);

/// Whether an entry of an object is true; false when it is not there or no truth value.
bool flagAt(const nlohmann::json& object, const char* key);

/// Measures as lines: {"fluid_ml": 12.25, "sigmoid": {"distension_mm": 9}} becomes "fluid 12.3 ml" and
/// "sigmoid: distension 9 mm". The unit is the key's last word where that is a unit; objects may nest one level.
std::vector<std::string> describeMeasures(const nlohmann::json& measures);

/// What ingest noted, as lines: texts as they are; objects by their "why", equal ones counted; of many the first few
/// and how many more there are.
std::vector<std::string> describeNotes(const nlohmann::json& notes);

std::string joinedLines(const std::vector<std::string>& lines);

}  // namespace vicon::report
