#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vicon/core/colon_parts.h"

namespace vicon {

/// Measures of the whole colon, or of one of its parts.
struct StretchQuality {
    std::optional<ColonPart> part;    ///< absent: the whole colon
    double median_radius_mm = 0;      ///< of the disc as large as the cross-section
    double collapsed_mm = 0;          ///< bridged, or narrower than quality.collapsed_radius_mm
    double collapsed_fraction = 0;    ///< of the length
    double longest_collapsed_mm = 0;  ///< without interruption
    double volume_ml = 0;             ///< gas and tagged fluid
    double fluid_ml = 0;              ///< tagged fluid
    double mottled_ml = 0;            ///< tagging in which wall cannot be told, see MottledTagging
    int faint_walls = 0;              ///< see FaintWall
    bool adequate = false;            ///< no collapsed stretch of quality.longest_collapsed_mm or more

    double fluidFraction() const { return volume_ml > 0 ? fluid_ml / volume_ml : 0; }
};

/// What a reader must know of a scan's quality.
enum class QualityReason {
    collapsed,           ///< a part, or the whole where parts are not known, over a length
    implausible_length,  ///< the colon's; it can hardly be the whole of it
    noise,               ///< more than usual
    mottled,             ///< tagging, in a part or in the whole
    faint_walls,         ///< closed although the scan hardly shows them
};
/// "collapsed", "implausible_length", "noise", "mottled", "faint_walls".
std::string nameOf(QualityReason reason);
/// Throws Error{bad_input} for any other name.
QualityReason qualityReasonFrom(const std::string& name);

/// A reason with its figure.
struct QualityNote {
    QualityReason reason = QualityReason::collapsed;
    std::optional<ColonPart> part;
    double value = 0;  ///< mm, of noise HU, of tagging ml, of walls how many
};
/// "sigmoid collapsed over 38 mm", "more noise than usual: 45 HU".
std::string textOf(const QualityNote& note);

/// A stretch of the centreline.
struct StationRange {
    double from_mm = 0, to_mm = 0;
};

/// How wide and how wet the lumen is along the centreline: one value for each step of it, from the rectal end.
struct LumenAlong {
    double step_mm = 0;
    std::vector<double> radius_mm;        ///< of the disc as large as the cross-section; 0 on bridges
    std::vector<double> fluid_fraction;   ///< of the lumen, 0 to 1
    std::vector<StationRange> collapsed;  ///< bridged, or narrower than quality.collapsed_radius_mm
};

struct ScanQuality {
    StretchQuality whole;               ///< adequate when every part is, and the length is plausible
    std::vector<StretchQuality> parts;  ///< from the rectum; empty where the parts are not known
    LumenAlong along;                   ///< empty in scans of earlier versions
    double noise_hu = 0;                ///< standard deviation in soft tissue; 0: no homogeneous place
    std::vector<QualityNote> notes;     ///< why not adequate, and what else a reader should know
    nlohmann::json thresholds = nlohmann::json::object();  ///< the options that it was judged by
    std::string reason;                                    ///< the notes in words; may be empty
};

/// As scan.json has it under "quality".
nlohmann::json toJson(const ScanQuality& quality);
/// What an earlier VICON did not write stays empty. Throws nlohmann::json::exception or Error{bad_input} for other
/// content.
ScanQuality scanQualityFromJson(const nlohmann::json& json);

}  // namespace vicon
