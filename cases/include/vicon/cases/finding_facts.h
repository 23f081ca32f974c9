#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/finding.h"
#include "vicon/cases/marker.h"
#include "vicon/core/colon_parts.h"
#include "vicon/core/skeleton.h"

namespace vicon {

class CaseStore;

// What follows from a finding's markers, each by one rule.

/// To a tenth of a mm: what is printed, what categories are decided by and what is compared is one number.
double roundedSize_mm(double size_mm);

/// The single largest dimension that was measured at a marker: of the largest diameter in the best plane and the
/// straight line between the clicked points the longer one. The length along the wall is no diameter and never counts.
/// Of an outlined polyp its own diameter.
double largestDiameter_mm(const MarkerSize& size);

/// The clock-face position of a point of the wall, 1 to 12: twelve is anterior, clockwise as seen from the anal side.
/// Nothing where the colon runs within 15 degrees of front to back, or the point lies within 1 mm of the centreline.
/// @param foot of the point on the centreline
/// @param tangent unit vector of the centreline there, towards the caecum
std::optional<int> clockFace(Point3 point, Point3 foot, Vector3 tangent);

/// How far an endoscope might have to go, an estimate.
struct EndoscopeDistance {
    double about_mm = 0, least_mm = 0, most_mm = 0;
};
/// The distance along the centreline times the published factor of its part: caecum 0.57, right colon 0.59, left colon
/// 0.78; between the flexures, and where the part is not known, the middle of the last two, and both bound it. The
/// range adds 20 % either way.
EndoscopeDistance endoscopeDistance(double station_mm, std::optional<ColonPart> part);
/// The factors, for words: {least, most}; the same twice but between the flexures.
std::pair<double, double> endoscopeFactors(std::optional<ColonPart> part);

/// A finding as one of its markers shows it.
struct FindingSight {
    std::string marker_id, scan_id;
    Point3 position_mm;
    double station_mm = 0, from_caecum_mm = 0, fraction = 0;
    std::optional<ColonPart> part;
    std::optional<int> clock_hour;
    std::optional<double> size_2d_mm;  ///< the largest diameter in the best plane, or between two points of a slice
    std::optional<double> size_3d_mm;  ///< between two points of the wall
    bool size_in_slice = false;        ///< size_2d_mm lies between two points of a slice
    std::optional<double> mean_hu;
    std::optional<double> part_fraction;  ///< how far along its part it lies, from the part's anal end; 0 to 1
    std::optional<double> size_least_mm, size_most_mm;      ///< of an outlined one: eight in ten diameters lie between
    std::optional<double> height_mm, volume_ml;             ///< of an outlined one
    std::optional<double> volume_least_ml, volume_most_ml;  ///< of an outlined one: eight in ten volumes lie between
};

/// Which size counts.
enum class SizeSource {
    reader,   ///< said by the reader
    plane,    ///< the largest diameter in the best plane
    slice,    ///< between two points of a slice
    surface,  ///< between two points of the wall
};
/// "reader", "best plane", "slice", "surface".
std::string nameOf(SizeSource source);

struct FindingFacts {
    std::vector<FindingSight> sights;  ///< in the finding's order of markers
    /// Of the sights, the one that says where the finding lies: that of the size that counts, else the first.
    std::optional<std::size_t> leading;
    std::optional<double> size_mm;  ///< the one that counts: the reader's, else the largest of all sights; rounded
    SizeSource size_source = SizeSource::reader;
    std::optional<double> size_2d_mm, size_3d_mm;  ///< the largest of all sights; rounded
    bool size_in_slice = false;                    ///< of size_2d_mm, as of its sight
    std::optional<EndoscopeDistance> endoscope;  ///< from the least to the most of all sights, about the leading one's
    std::optional<double> mean_hu;               ///< of the leading sight, else of the first that has one

    const FindingSight* lead() const { return leading ? &sights[*leading] : nullptr; }
};
nlohmann::json toJson(const FindingFacts& facts);
/// Throws Error{bad_input}.
FindingFacts factsFromJson(const nlohmann::json& json);

/// @param markers of the case
/// @param skeletons of its scans by id; a scan without one gives no clock-face position
/// @param parts of its scans by id; a scan without any gives no place within a part
FindingFacts factsOf(const Finding& finding, const std::vector<Marker>& markers,
                     const std::map<std::string, Skeleton>& skeletons,
                     const std::map<std::string, ColonPartRanges>& parts = {});

/// The centrelines of a case's scans that have one.
std::map<std::string, Skeleton> skeletonsOf(CaseStore& store, const std::string& case_id);

}  // namespace vicon
