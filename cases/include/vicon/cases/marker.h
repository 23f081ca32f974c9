#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/marker_measures.h"
#include "vicon/core/colon_parts.h"
#include "vicon/core/geometry.h"

namespace vicon {

enum class MarkerColor { red, yellow, green };
std::string nameOf(MarkerColor color);
/// Throws Error{wrong_use} for any other name.
MarkerColor markerColorFrom(const std::string& name);

/// A point of interest.
struct Marker {
    std::string id;  ///< "m1", "m2", ... within the case
    std::string scan_id;
    Point3 position_mm;
    MarkerColor color = MarkerColor::red;
    std::string note;  ///< UTF-8
    double station_mm = 0;
    double from_caecum_mm = 0;
    double fraction = 0;  ///< station / length of the skeleton
    std::string created;
    std::string changed;
    std::optional<ColonPart> part;  ///< where it lies; absent where the parts are not known
    /// The markers of the same finding in other scans, one in each at most; each of them names all others.
    std::vector<std::string> partners;
    std::optional<MarkerSize> size;
    std::optional<DensitySample> density;
    std::optional<MarkerView> view;  ///< from which it was placed
    /// What VICON does not know: keys of other programs, and a known key with other content than VICON's. Kept as it
    /// is.
    nlohmann::json extra = nlohmann::json::object();
};

/// "m2, m5": those of the same finding.
std::string partnerNames(const Marker& marker);

/// As docs/dev/schemas/markers.schema.json has it.
nlohmann::json toJson(const Marker& marker);
/// Throws Error{bad_input} when position or colour are missing or of the wrong type.
Marker markerFromJson(const nlohmann::json& json);

/// {"markers": [...]}, the form of markers.json and of files that markers are exchanged in.
nlohmann::json toJson(const std::vector<Marker>& markers);
/// Throws Error{store}.
void writeMarkers(const std::filesystem::path& file, const std::vector<Marker>& markers);
/// Throws Error{bad_input} when the file is none of markers, Error{not_found}.
std::vector<Marker> readMarkers(const std::filesystem::path& file);

}  // namespace vicon
