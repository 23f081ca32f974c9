#include "vicon/cases/finding_facts.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "vicon/cases/case_store.h"
#include "vicon/scan_files/skeleton_file.h"

namespace vicon {
namespace {

/// Published factors from the distance along a CT centreline to that along a colonoscope, which pleats the bowel.
/// Averages over patients, not chosen on any case here.
constexpr double kCaecumFactor = 0.57, kRightColonFactor = 0.59, kLeftColonFactor = 0.78;
/// Of 338 patients the caecum lay 75 to 257 cm away by CT, 65 to 150 cm by endoscope: the factors hide that spread.
constexpr double kEndoscopeSpread = 0.2;
/// Within it anterior and the direction of the colon are too near each other to say where twelve o'clock is.
constexpr double kLeastAngle_deg = 15;
constexpr double kLeastAway_mm = 1;
constexpr Vector3 kAnterior{0, -1, 0};

/// The larger of what there is.
std::optional<double> larger(std::optional<double> a, std::optional<double> b)
{
    return a && b ? std::max(a, b) : a ? a : b;
}

/// How far along its part a station lies; nothing where the part has no length, or is not where the marker says.
std::optional<double> fractionIn(const ColonPartRanges& parts, std::optional<ColonPart> part, double station_mm)
{
    for (const ColonPartRange& range : parts)
        if (part == range.part && range.to_mm > range.from_mm)
            return std::clamp((station_mm - range.from_mm) / (range.to_mm - range.from_mm), 0.0, 1.0);
    return std::nullopt;
}

void takeOutline(FindingSight& sight, const PolypSize& polyp)
{
    sight.size_least_mm = roundedSize_mm(polyp.least_mm);
    sight.size_most_mm = roundedSize_mm(polyp.most_mm);
    sight.height_mm = polyp.height_mm;
    sight.volume_ml = polyp.volume_ml;
    sight.volume_least_ml = polyp.volume_least_ml;
    sight.volume_most_ml = polyp.volume_most_ml;
}

void takeMeasured(FindingSight& sight, const MarkerSize& size)
{
    sight.size_in_slice = size.in_slice;
    (size.in_slice ? sight.size_2d_mm : sight.size_3d_mm) = roundedSize_mm(size.straight_mm);
    if (size.plane)
        sight.size_2d_mm = roundedSize_mm(size.plane->diameter_mm);
    if (size.polyp)
        takeOutline(sight, *size.polyp);
}

FindingSight sightOf(const Marker& marker, const std::map<std::string, Skeleton>& skeletons,
                     const std::map<std::string, ColonPartRanges>& parts)
{
    FindingSight sight{marker.id,
                       marker.scan_id,
                       marker.position_mm,
                       marker.station_mm,
                       marker.from_caecum_mm,
                       marker.fraction,
                       marker.part,
                       {},
                       {},
                       {},
                       {},
                       {}};
    if (marker.size)
        takeMeasured(sight, *marker.size);
    if (const auto known = parts.find(marker.scan_id); known != parts.end())
        sight.part_fraction = fractionIn(known->second, marker.part, marker.station_mm);
    if (marker.density && marker.density->voxels > 0)
        sight.mean_hu = marker.density->mean_hu;
    const auto skeleton = skeletons.find(marker.scan_id);
    if (skeleton != skeletons.end() && !skeleton->second.empty())
        sight.clock_hour = clockFace(marker.position_mm, skeleton->second.at(marker.station_mm).position_mm,
                                     skeleton->second.tangentAt(marker.station_mm));
    return sight;
}

std::optional<double> largestOf(const FindingSight& sight)
{
    return larger(sight.size_2d_mm, sight.size_3d_mm);
}

/// The sight whose size counts; the first where none was measured.
std::size_t leadingOf(const std::vector<FindingSight>& sights)
{
    std::size_t best = 0;
    for (std::size_t n = 1; n < sights.size(); ++n)
        if (largestOf(sights[n]).value_or(0) > largestOf(sights[best]).value_or(0))
            best = n;
    return best;
}

void takeSize(FindingFacts& facts, const Finding& finding)
{
    for (const FindingSight& sight : facts.sights) {
        if (sight.size_2d_mm && *sight.size_2d_mm > facts.size_2d_mm.value_or(0))
            facts.size_in_slice = sight.size_in_slice;
        facts.size_2d_mm = larger(facts.size_2d_mm, sight.size_2d_mm);
        facts.size_3d_mm = larger(facts.size_3d_mm, sight.size_3d_mm);
    }
    if (finding.read_size_mm) {
        facts.size_mm = roundedSize_mm(*finding.read_size_mm);
        facts.size_source = SizeSource::reader;
    } else {
        facts.size_mm = larger(facts.size_2d_mm, facts.size_3d_mm);
        // An outline's is the largest of all planes: its best one is beside it, and never leads.
        const bool by_plane = std::any_of(facts.sights.begin(), facts.sights.end(), [&](const FindingSight& sight) {
            return sight.size_2d_mm && sight.size_2d_mm == facts.size_mm && !sight.size_least_mm;
        });
        facts.size_source = !by_plane             ? SizeSource::surface
                            : facts.size_in_slice ? SizeSource::slice
                                                  : SizeSource::plane;
    }
}

}  // namespace

double roundedSize_mm(double size_mm)
{
    return std::round(size_mm * 10) / 10;
}

double largestDiameter_mm(const MarkerSize& size)
{
    if (size.polyp)
        return size.polyp->diameter_mm;
    return std::max(size.straight_mm, size.plane ? size.plane->diameter_mm : 0);
}

std::optional<int> clockFace(Point3 point, Point3 foot, Vector3 tangent)
{
    const auto across = [&](Vector3 v) { return v - tangent * dot(v, tangent); };
    const Vector3 up = across(kAnterior), to_point = across(point - foot);
    if (length(up) < std::sin(kLeastAngle_deg * std::numbers::pi / 180) || length(to_point) < kLeastAway_mm)
        return std::nullopt;
    const Vector3 right = cross(tangent, normalized(up));  // of who looks along the tangent, from the anal side
    const double angle = std::atan2(dot(to_point, right), dot(to_point, normalized(up)));
    const int hour = int(std::lround(angle / (std::numbers::pi / 6)));
    return hour <= 0 ? hour + 12 : hour;
}

std::pair<double, double> endoscopeFactors(std::optional<ColonPart> part)
{
    if (!part || *part == ColonPart::transverse)
        return {kRightColonFactor, kLeftColonFactor};
    switch (*part) {
        case ColonPart::caecum:
            return {kCaecumFactor, kCaecumFactor};
        case ColonPart::ascending:
        case ColonPart::hepatic_flexure:
            return {kRightColonFactor, kRightColonFactor};
        default:
            return {kLeftColonFactor, kLeftColonFactor};
    }
}

EndoscopeDistance endoscopeDistance(double station_mm, std::optional<ColonPart> part)
{
    const auto [least, most] = endoscopeFactors(part);
    return {station_mm * (least + most) / 2, station_mm * least * (1 - kEndoscopeSpread),
            station_mm * most * (1 + kEndoscopeSpread)};
}

FindingFacts factsOf(const Finding& finding, const std::vector<Marker>& markers,
                     const std::map<std::string, Skeleton>& skeletons,
                     const std::map<std::string, ColonPartRanges>& parts)
{
    FindingFacts facts;
    for (const std::string& id : finding.markers) {
        const auto marker = std::find_if(markers.begin(), markers.end(), [&](const Marker& m) { return m.id == id; });
        if (marker != markers.end())
            facts.sights.push_back(sightOf(*marker, skeletons, parts));
    }
    takeSize(facts, finding);
    if (facts.sights.empty())
        return facts;
    facts.leading = leadingOf(facts.sights);
    const FindingSight& lead = *facts.lead();
    facts.endoscope = endoscopeDistance(lead.station_mm, lead.part);
    for (const FindingSight& sight : facts.sights) {
        const EndoscopeDistance one = endoscopeDistance(sight.station_mm, sight.part);
        facts.endoscope->least_mm = std::min(facts.endoscope->least_mm, one.least_mm);
        facts.endoscope->most_mm = std::max(facts.endoscope->most_mm, one.most_mm);
        if (!facts.mean_hu)
            facts.mean_hu = sight.mean_hu;
    }
    if (lead.mean_hu)
        facts.mean_hu = lead.mean_hu;
    return facts;
}

std::map<std::string, Skeleton> skeletonsOf(CaseStore& store, const std::string& case_id)
{
    std::map<std::string, Skeleton> out;
    for (const ScanRecord& scan : store.scans(case_id)) {
        const auto file = store.scanFolder(case_id, scan.id) / "skeleton.vtp";
        if (std::filesystem::exists(file))
            out[scan.id] = scan_files::readSkeleton(file);
    }
    return out;
}

}  // namespace vicon
