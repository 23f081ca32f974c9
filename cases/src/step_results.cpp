#include "vicon/cases/step_results.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include "vicon/core/error.h"
#include "vicon/core/geometry_json.h"
#include "vicon/core/json_text.h"
#include "vicon/core/usual_densities.h"

using nlohmann::json;

namespace vicon {
namespace {

/// Reads a key if it is there.
template <class Value>
void take(const json& from, const char* key, Value& into)
{
    if (const auto found = from.find(key); found != from.end())
        into = found->get<Value>();
}

bool mayBeOfScan(Point3 p)
{
    constexpr double kFarthest_mm = 1e5;
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kFarthest_mm;
}

/// To hundredths: there may be thousands of blocks.
json toJson(const MottledTagging& mottled)
{
    json blocks = json::array();
    json shares = json::array();
    const auto rounded = [](double value) { return std::round(value * 100) / 100; };
    for (const Point3& p : mottled.blocks_mm)
        blocks.push_back(Point3{rounded(p.x), rounded(p.y), rounded(p.z)});
    for (const double share : mottled.shares)
        shares.push_back(rounded(share));
    return {{"block_mm", mottled.block_mm}, {"blocks_mm", std::move(blocks)}, {"shares", std::move(shares)}};
}

MottledTagging mottledFrom(const json& json)
{
    constexpr double kLeast_mm = 0.1, kMost_mm = 100;  // whoever looks for a block counts on that
    MottledTagging mottled{json.at("block_mm").get<double>(), json.at("blocks_mm").get<std::vector<Point3>>(), {}};
    mottled.shares.assign(mottled.blocks_mm.size(), 1);  // as records were before there were shares
    take(json, "shares", mottled.shares);
    const bool sound = mottled.block_mm >= kLeast_mm && mottled.block_mm <= kMost_mm &&
                       mottled.shares.size() == mottled.blocks_mm.size() &&
                       std::ranges::all_of(mottled.shares, [](double s) { return s >= 0 && s <= 1; }) &&
                       std::ranges::all_of(mottled.blocks_mm, mayBeOfScan);
    if (!sound)
        throw Error(ErrorCode::bad_input, "mottled tagging lies where no scan is");
    return mottled;
}

FaintWall faintWallFrom(const json& json)
{
    constexpr double kMost_mm2 = 1e6;
    const FaintWall wall{json.at("middle_mm").get<Point3>(), json.at("area_mm2").get<double>()};
    if (!mayBeOfScan(wall.middle_mm) || !(wall.area_mm2 >= 0 && wall.area_mm2 <= kMost_mm2))
        throw Error(ErrorCode::bad_input, "a faint wall lies where no scan is");
    return wall;
}

/// Voxels along each axis, if they are there.
void takeSize(const json& from, const char* key, std::array<int, 3>& into)
{
    if (const auto found = from.find(key); found != from.end())
        for (std::size_t axis = 0; axis < into.size(); ++axis)
            into[axis] = wholeNumber(found->at(axis));
}

/// What is left of a result when its known keys are taken away.
json without(json all, std::initializer_list<const char*> known)
{
    for (const char* key : known)
        all.erase(key);
    all.erase("files");  // the record's, not the step's
    return all;
}

}  // namespace

json toJson(const ResampleFound& found)
{
    return {{"acquired_size", found.acquired_size},
            {"acquired_spacing_mm", found.acquired_spacing_mm},
            {"size", found.size},
            {"spacing_mm", found.spacing_mm}};
}

ResampleFound resampleFoundFromJson(const json& json)
{
    ResampleFound found;
    takeSize(json, "acquired_size", found.acquired_size);
    take(json, "acquired_spacing_mm", found.acquired_spacing_mm);
    takeSize(json, "size", found.size);
    take(json, "spacing_mm", found.spacing_mm);
    return found;
}

json toJson(const SegmentFound& found)
{
    json out = found.measures;
    out["verdict"] = found.verdictText();
    out["confidence"] = found.confidence;
    out["reason"] = found.reason;
    out["plan"] = found.plan;
    if (!found.organ.isColon())
        out["organ"] = found.organ.name();
    if (found.given)
        out["given"] = toJson(*found.given);
    if (found.noise_hu)
        out["noise_hu"] = *found.noise_hu;
    json& bridges = out["bridges"] = json::array();
    for (const Bridge& bridge : found.bridges)
        bridges.push_back(toJson(bridge));
    return out;
}

std::optional<double> SegmentFound::acquiredNoise_hu() const
{
    const auto acquired = measures.find("acquired_noise_hu");
    return acquired != measures.end() && acquired->is_number() ? std::optional(acquired->get<double>()) : noise_hu;
}

std::optional<double> SegmentFound::usualNoise_hu() const
{
    const auto percent = measures.find("noise_percent");
    if (noise_hu || percent == measures.end() || !percent->is_number())
        return noise_hu;
    return percent->get<double>() / 100 * kUsualLumenToTissue_hu;
}

SegmentFound segmentFoundFromJson(const json& json)
{
    SegmentFound found;
    const std::string verdict = json.value("verdict", "");
    found.verdict = verdictFrom(verdict);
    found.organ_title = titleIn(verdict);
    take(json, "confidence", found.confidence);
    take(json, "reason", found.reason);
    found.organ = Organ(json.value("organ", Organ().name()));
    if (json.contains("given"))
        found.given = lumenOriginFromJson(json["given"]);
    if (json.contains("noise_hu"))
        found.noise_hu = json["noise_hu"].get<double>();
    for (const auto& bridge : json.value("bridges", nlohmann::json::array()))
        found.bridges.push_back(bridgeFromJson(bridge));
    take(json, "plan", found.plan);
    found.measures =
        without(json, {"verdict", "confidence", "reason", "organ", "given", "noise_hu", "bridges", "plan"});
    return found;
}

json toJson(const TissueFound& found)
{
    if (!found.not_sought.empty())
        return {{"not_sought", found.not_sought}};
    json measures = found.measures;
    if (found.blur_mm)
        measures["blur_mm"] = *found.blur_mm;
    json out = {{"measures", std::move(measures)}};
    if (!found.untrusted.mottled.blocks_mm.empty())
        out["mottled"] = toJson(found.untrusted.mottled);
    for (const FaintWall& wall : found.untrusted.faint)
        out["faint_walls"].push_back({{"middle_mm", wall.middle_mm}, {"area_mm2", wall.area_mm2}});
    return out;
}

TissueFound tissueFoundFromJson(const json& json)
{
    TissueFound found;
    take(json, "not_sought", found.not_sought);
    take(json, "measures", found.measures);
    if (const auto mottled = json.find("mottled"); mottled != json.end())
        found.untrusted.mottled = mottledFrom(*mottled);
    for (const auto& wall : json.value("faint_walls", nlohmann::json::array()))
        found.untrusted.faint.push_back(faintWallFrom(wall));
    if (found.measures.contains("blur_mm"))
        found.blur_mm = found.measures["blur_mm"].get<double>();
    found.measures.erase("blur_mm");
    return found;
}

json toJson(const SkeletonFound& found)
{
    json out = found.measures;
    out["length_mm"] = found.length_mm;
    return out;
}

SkeletonFound skeletonFoundFromJson(const json& json)
{
    return {json.value("length_mm", 0.0), without(json, {"length_mm"})};
}

json toJson(const QualityFound& found)
{
    if (!found.not_measured.empty())
        return {{"not_measured", found.not_measured}};
    json out = {{"parts", toJson(found.parts)}};
    if (!found.parts_unknown.empty())
        out["parts_unknown"] = found.parts_unknown;
    if (found.quality)
        out["quality"] = toJson(*found.quality);
    return out;
}

QualityFound qualityFoundFromJson(const json& json)
{
    QualityFound found;
    found.parts = colonPartsFromJson(json.value("parts", nlohmann::json::array()));
    take(json, "parts_unknown", found.parts_unknown);
    take(json, "not_measured", found.not_measured);
    if (json.contains("quality"))
        found.quality = scanQualityFromJson(json["quality"]);
    return found;
}

json toJson(const SubdivideFound& found)
{
    json out = found.measures;
    out["method"] = nameOf(found.method);
    out["triangles"] = found.triangles;
    return out;
}

SubdivideFound subdivideFoundFromJson(const json& json)
{
    SubdivideFound found;
    if (json.contains("method"))
        found.method = subdivideMethodFrom(json["method"]);
    if (json.contains("triangles"))
        found.triangles = wholeCount(json["triangles"]);
    found.measures = without(json, {"method", "triangles"});
    return found;
}

json toJson(const PotentialFound& found)
{
    json out = {{"largest_wall_distance_mm", found.largest_wall_distance_mm}};
    if (found.largest_exit_distance_mm)
        out["largest_exit_distance_mm"] = *found.largest_exit_distance_mm;
    return out;
}

PotentialFound potentialFoundFromJson(const json& json)
{
    PotentialFound found{json.value("largest_wall_distance_mm", 0.0), {}};
    if (json.contains("largest_exit_distance_mm"))
        found.largest_exit_distance_mm = json["largest_exit_distance_mm"].get<double>();
    return found;
}

std::string StepResults::warning() const
{
    if (!segment || segment->verdict == Verdict::found)
        return {};
    return segment->verdictText() + ": " + segment->reason;
}

namespace {

/// How the result of a step is read, by the step's name.
const std::map<std::string_view, void (*)(const json&, StepResults&)> kReaders = {
    {"resample", [](const json& from, StepResults& to) { to.resample = resampleFoundFromJson(from); }},
    {"segment", [](const json& from, StepResults& to) { to.segment = segmentFoundFromJson(from); }},
    {"tissue", [](const json& from, StepResults& to) { to.tissue = tissueFoundFromJson(from); }},
    {"skeleton", [](const json& from, StepResults& to) { to.skeleton = skeletonFoundFromJson(from); }},
    {"quality", [](const json& from, StepResults& to) { to.quality = qualityFoundFromJson(from); }},
    {"subdivide", [](const json& from, StepResults& to) { to.subdivide = subdivideFoundFromJson(from); }},
    {"potential", [](const json& from, StepResults& to) { to.potential = potentialFoundFromJson(from); }},
};

}  // namespace

StepResults resultsOf(const std::vector<StepRecord>& steps)
{
    StepResults results;
    for (const StepRecord& step : steps)
        try {
            if (const auto reader = kReaders.find(step.step); reader != kReaders.end())
                reader->second(step.result, results);
        } catch (const json::exception& e) {
            throw Error(ErrorCode::database, "what step '" + step.step + "' found cannot be read: " + e.what(), {},
                        "'vicon work' does a step again whose parameters are changed");
        }
    return results;
}

}  // namespace vicon
