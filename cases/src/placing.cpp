#include "vicon/cases/placing.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <utility>

#include "snapping.h"
#include "vicon/cases/density_sample.h"
#include "vicon/cases/polyp_size.h"
#include "vicon/cases/step_results.h"
#include "vicon/core/error.h"
#include "vicon/core/quantity.h"
#include "vicon/scan_files/cells_file.h"
#include "vicon/scan_files/volume_file.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

/// What was measured at another place is not this one's; what another program wrote under these names says no place.
void forgetMeasuresElsewhere(Marker& marker)
{
    if (marker.density && distance(marker.position_mm, marker.density->centre_mm) > kMeasureNear_mm)
        marker.density.reset();
    if (marker.size && outsideOf_mm(*marker.size, marker.position_mm) > kMeasureNear_mm)
        marker.size.reset();
    for (const char* key : {"density", "size"})
        marker.extra.erase(key);
}

std::string textOf(const char* pattern, double value)
{
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), pattern, value);
    return text.data();
}

std::string formatPoint(Point3 p)
{
    char text[96];
    std::snprintf(text, sizeof text, "%.1f,%.1f,%.1f", p.x, p.y, p.z);
    return text;
}

}  // namespace

ColonPartRanges partsOf(CaseStore& store, const ScanRecord& scan)
{
    return resultsOf(store.steps(scan.case_id, scan.id)).parts();
}

struct MarkerPlacer::Scan {
    ScanRecord record;
    std::unique_ptr<ScanPlaces> places;    // none: not read yet
    std::optional<ColonPartRanges> parts;  // likewise
};

struct MarkerPlacer::Found {
    Scan* scan;
    SnappedPoint place;
};

MarkerPlacer::MarkerPlacer(CaseStore& store, const MarkOptions& options, std::string case_id)
    : store_(store), options_(options), case_id_(std::move(case_id))
{
    for (const ScanRecord& scan : store.scans(case_id_))
        scans_.push_back({scan, {}, {}});
}

MarkerPlacer::~MarkerPlacer() = default;

const ScanPlaces& MarkerPlacer::placesOf(Scan& scan)
{
    if (!scan.places)
        scan.places = std::make_unique<ScanPlaces>(store_.scanFolder(case_id_, scan.record.id));
    return *scan.places;
}

MarkerPlacer::Found MarkerPlacer::find(const Marker& marker)
{
    std::vector<Found> found;
    for (Scan& scan : scans_) {
        const std::string& id = scan.record.id;
        const bool named = !marker.scan_id.empty() && id.starts_with(marker.scan_id);
        if (marker.scan_id.empty() ? !isPrepared(store_.scanFolder(case_id_, id)) : !named)
            continue;
        if (const auto place = placesOf(scan).at(marker.position_mm, options_.most_distance_mm))
            found.push_back({&scan, *place});
    }
    if (found.empty() && !marker.scan_id.empty())
        store_.requireScan(case_id_, marker.scan_id);
    if (found.empty())
        throw Error(ErrorCode::bad_input,
                    "the point " + formatPoint(marker.position_mm) +
                        textOf(" lies more than %.3g mm outside the lumen of ", options_.most_distance_mm) +
                        (marker.scan_id.empty() ? "every prepared scan" : "scan " + marker.scan_id),
                    case_id_, "give LPS millimetres inside the lumen; 'vicon show " + case_id_ + "' shows the scans");
    // A point in the lumen of one scan and merely near that of another belongs to the first.
    const auto inside = [](const Found& f) { return f.place.outside_mm == 0; };
    if (found.size() > 1 && std::count_if(found.begin(), found.end(), inside) == 1)
        found = {*std::find_if(found.begin(), found.end(), inside)};
    if (found.size() > 1)
        throw Error(ErrorCode::wrong_use, "the point lies in the lumen of several scans", case_id_,
                    "name one with --scan; 'vicon show " + case_id_ + "' lists them");
    return found.front();
}

Marker MarkerPlacer::place(Marker marker)
{
    const auto [scan, place] = find(marker);
    marker.scan_id = scan->record.id;
    marker.station_mm = place.station_mm;
    marker.from_caecum_mm = place.length_mm - place.station_mm;
    marker.fraction = place.length_mm > 0 ? place.station_mm / place.length_mm : 0;
    forgetMeasuresElsewhere(marker);
    if (!scan->parts)
        scan->parts = partsOf(store_, scan->record);
    const std::string part = partNameAt(*scan->parts, place.station_mm);
    marker.part = part.empty() ? std::nullopt : std::optional(colonPartFrom(part));
    marker.extra.erase("part");
    return marker;
}

Marker placeMarker(CaseStore& store, const MarkOptions& options, const std::string& case_id, Marker marker)
{
    return MarkerPlacer(store, options, case_id).place(std::move(marker));
}

std::vector<MarkerEdit> importOf(CaseStore& store, const MarkOptions& options, const std::string& case_id,
                                 const fs::path& file, Progress& progress)
{
    const std::vector<Marker> known = store.markers(case_id);
    MarkerPlacer placer(store, options, case_id);
    std::vector<MarkerEdit> edits;
    const std::vector<Marker> markers = readMarkers(file);
    for (const Marker& marker : markers) {
        progress.check();
        progress.report(double(edits.size()) / double(markers.size()), "placing markers");
        const Marker placed = placer.place(marker);
        const auto before =
            std::find_if(known.begin(), known.end(), [&](const Marker& m) { return m.id == placed.id; });
        edits.push_back({before == known.end() ? std::nullopt : std::optional(*before), placed});
    }
    return edits;
}

std::vector<std::string> renewPlaces(CaseStore& store, const MarkOptions& options, const std::string& case_id,
                                     const std::string& scan_id)
{
    std::vector<std::string> lost;
    MarkerPlacer placer(store, options, case_id);
    for (const Marker& marker : store.markers(case_id)) {
        if (!scan_id.empty() && marker.scan_id != scan_id)
            continue;
        try {
            if (const Marker placed = placer.place(marker); toJson(placed) != toJson(marker))
                store.editMarkers(case_id, {{marker, placed}});
        } catch (const Error& e) {
            if (e.code() == ErrorCode::bad_input)
                lost.push_back(marker.id);
            else if (e.code() != ErrorCode::not_ready)
                throw;
        }
    }
    return lost;
}

void addDensity(CaseStore& store, const std::string& case_id, Marker& marker, double radius_mm)
{
    if (quantityOf(store.requireScan(case_id, marker.scan_id).series) == Quantity::signal)
        throw Error(ErrorCode::wrong_use, "a biopsy measures densities, and MR has none", marker.scan_id);
    const fs::path folder = store.scanFolder(case_id, marker.scan_id);
    const auto volume = scan_files::readVolume<std::int16_t>(folder / "volume.mha");
    const auto inside = scan_files::readVolume<std::uint8_t>(folder / "inside.mha");
    const CircledWall wall = circleWall(scan_files::readCells(folder / "cells.vtp"), marker.position_mm, radius_mm);
    const DensitySample sample = sampleDensity(volume, inside, marker.position_mm, radius_mm, wall);
    if (sample.voxels == 0)
        throw Error(ErrorCode::wrong_use,
                    textOf("within %.1f mm of the point there is too little tissue between its surface and its far "
                           "side to measure its density; nothing was taken",
                           radius_mm),
                    case_id, "mark the middle of the finding at half its height, or choose a larger ball");
    marker.density = sample;
}

void addPolypSize(CaseStore& store, const std::string& case_id, Marker& marker)
{
    const fs::path folder = store.scanFolder(case_id, marker.scan_id);
    const PolypOutline outline = outlinePolyp(scan_files::readCells(folder / "cells.vtp"),
                                              scan_files::readVolume<std::uint8_t>(folder / "inside.mha"),
                                              marker.position_mm, blurAndNoiseOf(folder));
    if (!outline.size)
        throw Error(ErrorCode::wrong_use, "the polyp cannot be outlined: " + outline.trouble, case_id,
                    "measure it between two clicks in 'vicon read'");
    marker.size = sizeOf(outline);
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

}  // namespace vicon
