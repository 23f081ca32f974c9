#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/given_lumen.h"
#include "vicon/cases/records.h"
#include "vicon/core/bridge.h"
#include "vicon/core/colon_parts.h"
#include "vicon/core/organ.h"
#include "vicon/core/scan_quality.h"
#include "vicon/core/subdivision.h"
#include "vicon/core/untrusted_wall.h"
#include "vicon/core/verdict.h"

namespace vicon {

// What each step of the pipeline found out about a scan, as its record keeps it. Each has one JSON form, described in
// docs/dev/schemas/scan.schema.json. Reading is lenient: what is missing keeps its default. `measures` are figures that
// no program of VICON reads, for whoever looks into a scan.

struct ResampleFound {
    std::array<int, 3> acquired_size{};
    std::array<double, 3> acquired_spacing_mm{};
    std::array<int, 3> size{};
    double spacing_mm = 0;
};
nlohmann::json toJson(const ResampleFound& found);
ResampleFound resampleFoundFromJson(const nlohmann::json& json);

struct SegmentFound {
    Verdict verdict = Verdict::unsure;
    std::string organ_title;  ///< in words: "colon"; empty where the verdict is unsure and was read from a file
    double confidence = 0;    ///< 0 to 1
    std::string reason;       ///< why, for a person
    Organ organ;
    std::optional<LumenOrigin> given;                ///< where the lumen came from, if VICON did not find it
    std::optional<double> noise_hu;                  ///< in soft tissue, as the lumen was sought; of a colon
    std::vector<Bridge> bridges;                     ///< without their paths, which are in the plan
    nlohmann::json plan = nlohmann::json::object();  ///< pieces and bridges as the skeleton step reads them
    nlohmann::json measures = nlohmann::json::object();

    /// "colon", "unsure" or "no colon".
    std::string verdictText() const { return vicon::verdictText(verdict, organ_title); }
    /// The noise of the densities as they were acquired, which are softened where a kernel is sharp.
    std::optional<double> acquiredNoise_hu() const;
    /// The noise where air and tissue have CT's usual densities: of MR on that scale. Nothing where it was not
    /// measured.
    std::optional<double> usualNoise_hu() const;
};
nlohmann::json toJson(const SegmentFound& found);
SegmentFound segmentFoundFromJson(const nlohmann::json& json);

struct TissueFound {
    std::string not_sought;         ///< why the wall was not placed; the rest is then empty
    std::optional<double> blur_mm;  ///< standard deviation of the scan's blur, as its fluid levels show it
    UntrustedWall untrusted;
    nlohmann::json measures = nlohmann::json::object();
};
nlohmann::json toJson(const TissueFound& found);
TissueFound tissueFoundFromJson(const nlohmann::json& json);

struct SkeletonFound {
    double length_mm = 0;  ///< of the path; of a tree, to its farthest tip
    nlohmann::json measures = nlohmann::json::object();
};
nlohmann::json toJson(const SkeletonFound& found);
SkeletonFound skeletonFoundFromJson(const nlohmann::json& json);

struct QualityFound {
    ColonPartRanges parts;      ///< empty where they are not known
    std::string parts_unknown;  ///< why not
    std::optional<ScanQuality> quality;
    std::string not_measured;  ///< why nothing of this was sought
};
nlohmann::json toJson(const QualityFound& found);
QualityFound qualityFoundFromJson(const nlohmann::json& json);

struct SubdivideFound {
    std::optional<SubdivideMethod> method;
    std::size_t triangles = 0;
    nlohmann::json measures = nlohmann::json::object();  ///< the subdivision's statistics
};
nlohmann::json toJson(const SubdivideFound& found);
SubdivideFound subdivideFoundFromJson(const nlohmann::json& json);

struct PotentialFound {
    double largest_wall_distance_mm = 0;
    std::optional<double> largest_exit_distance_mm;  ///< nothing where no path leads to an exit
};
nlohmann::json toJson(const PotentialFound& found);
PotentialFound potentialFoundFromJson(const nlohmann::json& json);

/// What the steps that were done found.
struct StepResults {
    std::optional<ResampleFound> resample;
    std::optional<SegmentFound> segment;
    std::optional<TissueFound> tissue;
    std::optional<SkeletonFound> skeleton;
    std::optional<QualityFound> quality;
    std::optional<SubdivideFound> subdivide;
    std::optional<PotentialFound> potential;

    /// The colon where segment has not been done.
    Organ organ() const { return segment ? segment->organ : Organ(); }
    /// Empty where they are not known.
    ColonPartRanges parts() const { return quality ? quality->parts : ColonPartRanges(); }
    /// What a person must be told of a scan whose organ was not found, or not surely; empty where all is well.
    std::string warning() const;
};
/// Throws Error{database} when a record makes no sense.
StepResults resultsOf(const std::vector<StepRecord>& steps);

}  // namespace vicon
