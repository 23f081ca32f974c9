#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "vicon/core/option_names.h"
#include "vicon/core/progress.h"
#include "vicon/viewer/model/flight_quality.h"
#include "vicon/viewer/model/unseen.h"
#include "vicon/viewer/scene/snapshot.h"

namespace vicon::viewer {

/// Where a planned flight leads; of a tree from the root to a tip.
enum class FlightDirection { to_caecum, to_rectum, both };
inline constexpr EnumNames<FlightDirection, 5> kFlightDirectionNames{{
    {FlightDirection::to_caecum, "caecum"},
    {FlightDirection::to_caecum, "tip"},
    {FlightDirection::to_rectum, "rectum"},
    {FlightDirection::to_rectum, "root"},
    {FlightDirection::both, "both"},
}};
constexpr const auto& optionNames(FlightDirection /*value*/)
{
    return kFlightDirectionNames;
}

/// A planned flight along the centreline.
struct FlightRequest {
    FlightDirection direction = FlightDirection::to_caecum;
    double step_mm = 4;  ///< between poses, along the centreline
    int frames = 0;      ///< above 0: that many poses in each direction, instead of a step
    int width = 0;       ///< pixels of a frame; 0: 512
    int height = 0;      ///< 0: 512
    double view_angle_deg = 90;
    WallLook wall;
    bool write_frames = true;                    ///< frames as PNG, "frame-00001.png" and on
    bool measure_coverage = true;                ///< which triangles are seen; costs a second rendering of each frame
    bool cull = true;                            ///< draw only cells that may be seen
    double least_unseen_mm2 = kLeastUnseen_mm2;  ///< smaller unseen patches are not listed
    std::filesystem::path out;                   ///< folder for frames and flight.json; empty: nothing is written
    std::vector<Marker> markers;
    Caption caption;
};

/// A pose of a flight and what its frame took.
struct FlightFrame {
    Pose pose;
    double station_mm = 0;
    double clearance_mm = 0;
    bool towards_caecum = true;
    std::size_t cells_drawn = 0;
    std::size_t triangles_drawn = 0;
    std::size_t triangles_seen = 0;  ///< in this frame; 0 where coverage is not measured
    double seconds = 0;              ///< to render the surface (shaded; without frames: in the colours of coverage)
};

struct FlightLegQuality {
    Heading heading = Heading::caecum;
    FlightQuality quality;
};

/// What a flight found out.
struct FlightReport {
    std::vector<FlightFrame> frames;
    std::vector<FlightLegQuality> views;  ///< how well they can be read, each direction that was flown
    double length_mm = 0;
    bool tree = false;  ///< the organ branches: "to the caecum" is to the tip, "to the rectum" to the root
    std::size_t cells = 0, triangles = 0;  ///< of the whole surface
    double coverage = 0;  ///< part of the surface's area that was seen, 0 to 1; 0 where it is not measured
    double reviewed = 0;  ///< part that was seen steeply and closely enough, see review_rule.h
    double seen_mm2 = 0, whole_mm2 = 0;
    std::vector<UnseenPatch> unseen;  ///< the largest first; empty where coverage is not measured
    ColonPartRanges parts;            ///< by which the patches' stations are named
    double average_cells = 0, average_triangles = 0, average_seen = 0;
    double median_seconds = 0, slow_seconds = 0;  ///< of the frames; slow: 95 % are faster
};
/// Everything, poses included. Keys carry units.
nlohmann::json toJson(const FlightReport& report);

/// Flies through a scan. Bridges are skipped. Writes each frame by replaceFile(), and flight.json at the end.
/// Throws as renderSnapshot() does, and Error{cancelled}.
FlightReport fly(const PreparedScan& scan, const FlightRequest& request, Progress& progress);

}  // namespace vicon::viewer
