#include "marking.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "text_table.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/scan_files/subdivision_file.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/viewer/model/biopsy.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

/// Segments end where flooded fronts met, not across the curve, so a point's foot may lie in the neighbour. Less than
/// half of the least distance along the curve between two loops that touch. Seen on seed 1 of the default phantom, in a
/// bend.
constexpr double kSegmentMargin_mm = 20;

struct NearestVoxel {
    int segment = 0;
    double distance_mm = 1e300;
};

/// The inside voxel nearest to `p` within a ball, by its centre; a point within half a voxel of it counts as inside.
NearestVoxel nearestInside(const SegmentVolume& segments, Point3 p, double within_mm)
{
    const Grid& grid = segments.grid;
    const Index3 centre = grid.indexAt(p);
    NearestVoxel nearest;
    std::array<int, 3> reach{};
    for (std::size_t a = 0; a < 3; ++a)
        reach[a] = int(std::ceil(within_mm / grid.spacing_mm[a])) + 1;
    for (int k = std::max(0, centre.k - reach[2]); k <= std::min(grid.size[2] - 1, centre.k + reach[2]); ++k)
        for (int j = std::max(0, centre.j - reach[1]); j <= std::min(grid.size[1] - 1, centre.j + reach[1]); ++j)
            for (int i = std::max(0, centre.i - reach[0]); i <= std::min(grid.size[0] - 1, centre.i + reach[0]); ++i)
                if (const int segment = segments.at({i, j, k})) {
                    const double d = distance(grid.pointAt(Index3{i, j, k}), p);
                    if (d < nearest.distance_mm)
                        nearest = {segment, d};
                }
    if (segments.valueOr(centre, 0))
        nearest.distance_mm = 0;
    return nearest;
}

bool isPrepared(const fs::path& folder)
{
    return fs::exists(folder / "skeleton.vtp") && fs::exists(folder / "segments.mha") &&
           fs::exists(folder / "subdivision.json");
}

/// A density or a size belongs to a marker this near to where it was taken, as the reading room has it.
constexpr double kMeasureNear_mm = 10;

bool isNear(const Marker& marker, const nlohmann::json& measure, const char* key)
{
    const auto at = measure.is_object() ? measure.find(key) : measure.end();
    if (at == measure.end() || !at->is_array() || at->size() != 3)
        return false;
    for (const auto& number : *at)
        if (!number.is_number())
            return false;
    return distance(marker.position_mm, {(*at)[0], (*at)[1], (*at)[2]}) <= kMeasureNear_mm;
}

/// What was measured at another place is not this one's.
void forgetMeasuresElsewhere(Marker& marker)
{
    const auto density = marker.extra.find("density");
    if (density != marker.extra.end() && !isNear(marker, *density, "position_mm"))
        marker.extra.erase("density");
    const auto size = marker.extra.find("size");
    if (size != marker.extra.end() && !isNear(marker, *size, "from_mm") && !isNear(marker, *size, "to_mm"))
        marker.extra.erase("size");
}

std::string formatPoint(Point3 p)
{
    char text[96];
    std::snprintf(text, sizeof text, "%.1f,%.1f,%.1f", p.x, p.y, p.z);
    return text;
}

}  // namespace

Point3 pointFrom(const std::string& text, const char* option)
{
    Point3 p;
    char comma1 = 0, comma2 = 0;
    std::istringstream in(text);
    if (!(in >> p.x >> comma1 >> p.y >> comma2 >> p.z) || comma1 != ',' || comma2 != ',' || !(in >> std::ws).eof() ||
        !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw Error(ErrorCode::wrong_use, "'" + text + "' is not a point", option,
                    std::string("write X,Y,Z in LPS mm, as in ") + option + "=12.5,-30,410");
    return p;
}

namespace {

/// The skeleton; of a tree the way from the root that passes nearest to the point.
Skeleton wayThrough(const fs::path& file, Point3 point)
{
    const SkeletonTree tree = scan_files::readSkeletonTree(file);
    if (tree.empty())
        return scan_files::readSkeleton(file);
    Skeleton best;
    double least_mm = 1e300;
    for (const int tip : tree.tips()) {
        Skeleton way = tree.pathTo(tip);
        if (const double away_mm = way.nearest(point).distance_mm; away_mm < least_mm) {
            least_mm = away_mm;
            best = std::move(way);
        }
    }
    return best;
}

}  // namespace

std::optional<SnappedPoint> snapToSkeleton(const fs::path& folder, Point3 point, double within_mm)
{
    if (!isPrepared(folder))
        throw Error(ErrorCode::not_ready, "the scan has not been through the pipeline", folder.filename().string(),
                    "run 'vicon work --until-idle'");
    const auto segments = scan_files::readVolume<std::uint16_t>(folder / "segments.mha");
    const NearestVoxel voxel = nearestInside(segments, point, within_mm);
    if (voxel.segment == 0 || voxel.distance_mm > within_mm)
        return std::nullopt;
    const Skeleton skeleton = wayThrough(folder / "skeleton.vtp", point);
    const auto subdivision = scan_files::readSubdivision(folder / "subdivision.json");
    const auto& info = subdivision.segments.at(std::size_t(voxel.segment) - 1);
    const SkeletonFoot foot =
        skeleton.nearest(point, info.from_station_mm - kSegmentMargin_mm, info.to_station_mm + kSegmentMargin_mm);
    return SnappedPoint{voxel.distance_mm, foot.station_mm, skeleton.length_mm()};
}

ColonPartRanges partsOf(CaseStore& store, const ScanRecord& scan)
{
    for (const StepRecord& step : store.steps(scan.case_id, scan.id))
        if (step.result.contains("parts"))
            return colonPartsFromJson(step.result["parts"]);
    return {};
}

Marker placeMarker(CaseStore& store, const MarkOptions& options, const std::string& case_id, Marker marker)
{
    std::vector<std::pair<std::string, SnappedPoint>> places;
    for (const ScanRecord& scan : store.scans(case_id)) {
        const fs::path folder = store.scanFolder(case_id, scan.id);
        const bool named = !marker.scan_id.empty() && scan.id.starts_with(marker.scan_id);
        if (marker.scan_id.empty() ? !isPrepared(folder) : !named)
            continue;
        if (const auto place = snapToSkeleton(folder, marker.position_mm, options.most_distance_mm))
            places.emplace_back(scan.id, *place);
    }
    if (places.empty() && !marker.scan_id.empty())
        store.requireScan(case_id, marker.scan_id);
    if (places.empty())
        throw Error(ErrorCode::bad_input,
                    "the point " + formatPoint(marker.position_mm) + " lies more than " +
                        formatPoint({options.most_distance_mm, 0, 0}).substr(0, 4) +
                        " mm outside the lumen of every prepared scan",
                    case_id, "give LPS millimetres inside the lumen; 'vicon show " + case_id + "' shows the scans");
    // A point in the lumen of one scan and merely near that of another belongs to the first.
    const auto inside = [](const auto& place) { return place.second.outside_mm == 0; };
    if (places.size() > 1 && std::count_if(places.begin(), places.end(), inside) == 1)
        places = {*std::find_if(places.begin(), places.end(), inside)};
    if (places.size() > 1)
        throw Error(ErrorCode::wrong_use, "the point lies in the lumen of several scans", case_id,
                    "name one with --scan; 'vicon show " + case_id + "' lists them");
    const auto& [scan_id, place] = places.front();
    marker.scan_id = scan_id;
    marker.station_mm = place.station_mm;
    marker.from_caecum_mm = place.length_mm - place.station_mm;
    marker.fraction = place.length_mm > 0 ? place.station_mm / place.length_mm : 0;
    forgetMeasuresElsewhere(marker);
    marker.extra.erase("part");
    if (const std::string part = partNameAt(partsOf(store, store.requireScan(case_id, scan_id)), place.station_mm);
        !part.empty())
        marker.extra["part"] = part;
    return marker;
}

std::vector<MarkerEdit> importOf(CaseStore& store, const MarkOptions& options, const std::string& case_id,
                                 const std::filesystem::path& file)
{
    const auto json = nlohmann::json::parse(readFile(file), nullptr, false);
    if (json.is_discarded() || !json.is_object() || !json.contains("markers") || !json["markers"].is_array())
        throw Error(ErrorCode::bad_input, "is not a file of markers", file.string(), "it must be {\"markers\": [...]}");
    const std::vector<Marker> known = store.markers(case_id);
    std::vector<MarkerEdit> edits;
    for (const auto& entry : json["markers"]) {
        const Marker placed = placeMarker(store, options, case_id, markerFromJson(entry));
        const auto before =
            std::find_if(known.begin(), known.end(), [&](const Marker& m) { return m.id == placed.id; });
        edits.push_back({before == known.end() ? std::nullopt : std::optional(*before), placed});
    }
    return edits;
}

void renewPlaces(CaseStore& store, const MarkOptions& options, const std::string& case_id, const std::string& scan_id)
{
    for (const Marker& marker : store.markers(case_id)) {
        if (marker.scan_id != scan_id)
            continue;
        try {
            if (const Marker placed = placeMarker(store, options, case_id, marker); toJson(placed) != toJson(marker))
                store.editMarkers(case_id, {{marker, placed}});
        } catch (const Error& e) {
            if (e.code() != ErrorCode::bad_input && e.code() != ErrorCode::not_ready)
                throw;
        }
    }
}

void addDensity(CaseStore& store, const std::string& case_id, Marker& marker, double radius_mm)
{
    const fs::path folder = store.scanFolder(case_id, marker.scan_id);
    const auto volume = scan_files::readVolume<std::int16_t>(folder / "volume.mha");
    const auto inside = scan_files::readVolume<std::uint8_t>(folder / "inside.mha");
    const viewer::Biopsy biopsy = viewer::takeBiopsy(volume, inside, marker.position_mm, radius_mm);
    if (biopsy.voxels == 0)
        throw Error(ErrorCode::wrong_use,
                    "too little tissue lies within " + formatNumber(radius_mm, 1) +
                        " mm of the point and far enough from gas and fluid to measure its density",
                    case_id, "mark a point on the wall or within the finding, or choose a larger ball");
    marker.extra["density"] = viewer::toJson(biopsy);
}

ScanRecord requirePreparedScan(CaseStore& store, const std::string& case_id, const std::string& scan_id)
{
    if (!scan_id.empty()) {
        ScanRecord scan = store.requireScan(case_id, scan_id);
        if (!isPrepared(store.scanFolder(case_id, scan.id)))
            throw Error(ErrorCode::not_ready, "the scan has not been through the pipeline, or holds no colon",
                        case_id + "/" + scan.id, "see 'vicon show " + case_id + "'; 'vicon work --until-idle' runs it");
        return scan;
    }
    for (ScanRecord& scan : store.scans(case_id))
        if (isPrepared(store.scanFolder(case_id, scan.id)))
            return std::move(scan);
    throw Error(ErrorCode::not_ready, "no scan of the case has been through the pipeline, or none holds a colon",
                case_id, "see 'vicon show " + case_id + "'; 'vicon work --until-idle' runs it");
}

}  // namespace vicon::app
