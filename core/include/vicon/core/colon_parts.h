#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vicon {

/// The parts of the colon, in order from the rectum, as DICOM's CID 6210 names them.
enum class ColonPart { rectum, sigmoid, descending, splenic_flexure, transverse, hepatic_flexure, ascending, caecum };

/// "rectum", "sigmoid", "descending", "splenic flexure", "transverse", "hepatic flexure", "ascending", "caecum".
std::string nameOf(ColonPart part);
/// Throws Error{bad_input} for any other name.
ColonPart colonPartFrom(const std::string& name);

/// Where a part lies along the skeleton.
struct ColonPartRange {
    ColonPart part = ColonPart::rectum;
    double from_mm = 0;  ///< stations
    double to_mm = 0;
};

/// All eight parts in order, each beginning where the one before ends; empty where they are not known.
using ColonPartRanges = std::vector<ColonPartRange>;

/// [{"name","from_mm","to_mm"}], as scan.json has it under "parts".
nlohmann::json toJson(const ColonPartRanges& parts);
/// Throws Error{bad_input} when a key is missing, of the wrong type or an unknown name.
ColonPartRanges colonPartsFromJson(const nlohmann::json& json);

/// The name of the part at a station; empty where the parts are not known. Before the first and beyond the last: those.
std::string partNameAt(const ColonPartRanges& parts, double station_mm);

}  // namespace vicon
