#include "report_pictures.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>

#include "vicon/cases/bridges.h"
#include "vicon/cases/organs.h"
#include "vicon/cases/placing.h"
#include "vicon/cases/step_results.h"
#include "vicon/core/error.h"
#include "vicon/viewer/scene/display.h"
#include "vicon/viewer/scene/measures_picture.h"
#include "vicon/viewer/scene/snapshot.h"

namespace fs = std::filesystem;
using vicon::viewer::SnapshotRequest;

namespace vicon::app {
namespace {

constexpr int kEndoscopicSide = 900;
constexpr int kSlicesWidth = 1200, kSlicesHeight = 900;
constexpr int kMeasuresSide = 600;
constexpr int kOverviewWidth = 900, kOverviewHeight = 1100;

std::vector<Marker> markersOf(const ReadCase& read, const ScanRecord& scan)
{
    std::vector<Marker> markers = read.markers;
    std::erase_if(markers, [&](const Marker& m) { return m.scan_id != scan.id; });
    std::stable_sort(markers.begin(), markers.end(),
                     [](const Marker& a, const Marker& b) { return a.station_mm < b.station_mm; });
    return markers;
}

/// The markers with the numbers of their findings in place of their ids.
std::vector<Marker> numbered(const ReadCase& read, std::vector<Marker> markers)
{
    for (Marker& marker : markers)
        for (const auto& [finding, facts] : read.findings)
            if (std::find(finding.markers.begin(), finding.markers.end(), marker.id) != finding.markers.end()) {
                marker.id = std::to_string(finding.number());
                break;
            }
    return markers;
}

bool hasColon(const fs::path& folder)
{
    return fs::exists(folder / "cells.vtp") && fs::exists(folder / "skeleton.vtp");
}

std::string labelOf(const ScanRecord& scan)
{
    return positionName(scan.series.patient_position) + " (series " + std::to_string(scan.series.number) + ")";
}

SnapshotRequest requestFor(SnapshotRequest::View view, const CaseRecord& record, const ScanRecord& scan, int width,
                           int height)
{
    SnapshotRequest request;
    request.view = view;
    request.caption = viewer::captionFor(record, scan);
    request.width = width;
    request.height = height;
    return request;
}

report::ScanEntry describeScan(CaseStore& store, const ScanRecord& scan)
{
    report::ScanEntry entry{.scan = scan};
    const StepResults results = resultsOf(store.steps(scan.case_id, scan.id));
    if (results.segment) {
        entry.verdict = results.segment->verdictText();
        entry.confidence = results.segment->confidence;
        entry.reason = results.segment->reason;
    }
    if (results.skeleton)
        entry.skeleton_length_mm = results.skeleton->length_mm;
    if (results.quality)
        entry.quality = results.quality->quality;
    entry.bridges = reviewedBridges(store, scan);
    return entry;
}

/// The scan's files; nothing where it is not prepared (now): its markers are told without pictures.
std::optional<viewer::PreparedScan> openPrepared(const fs::path& folder)
{
    if (!hasColon(folder))
        return {};
    return viewer::PreparedScan::open(folder);
}

void drawPictures(const viewer::PreparedScan& prepared, const std::pair<const CaseRecord&, const ScanRecord&>& of,
                  const PictureFolder& pictures, report::MarkerEntry& entry)
{
    const CaseRecord& record = of.first;
    const ScanRecord& scan = of.second;
    const Marker& marker = entry.marker;
    const auto draw = [&](SnapshotRequest::View view, int width, int height, const std::string& name) {
        auto request = requestFor(view, record, scan, width, height);
        request.look_at_mm = marker.position_mm;
        request.station_mm = marker.station_mm;
        request.markers = {marker};
        viewer::renderSnapshot(prepared, request, pictures / name);
        return pictures / name;
    };
    entry.endoscopic_picture =
        draw(SnapshotRequest::View::endo, kEndoscopicSide, kEndoscopicSide, marker.id + "-endo.png");
    entry.slices_picture = draw(SnapshotRequest::View::slices, kSlicesWidth, kSlicesHeight, marker.id + "-slices.png");
    if (const auto measures =
            viewer::measuresPicture(prepared, marker, viewer::captionFor(record, scan), kMeasuresSide)) {
        entry.measures_picture = pictures / (marker.id + "-measures.png");
        viewer::writePng(entry.measures_picture, *measures);
    }
}

}  // namespace

PictureFolder::PictureFolder()
{
    std::string name = (fs::temp_directory_path() / "vicon-report-XXXXXX").string();
    if (!::mkdtemp(name.data()))
        throw Error(ErrorCode::store, "a temporary folder cannot be made", name);
    path_ = name;
}

PictureFolder::~PictureFolder()
{
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::vector<report::ScanEntry> drawScans(CaseStore& store, const ReadCase& read, const PictureFolder& pictures,
                                         Progress& progress)
{
    const viewer::Display display;
    const CaseRecord& record = read.record;
    std::vector<report::ScanEntry> entries;
    for (const ScanRecord& scan : store.scans(record.id)) {
        if (scan.role != ScanRole::scan && markersOf(read, scan).empty())
            continue;
        progress.check();
        progress.report(0, "overview of " + scan.id);
        report::ScanEntry entry = describeScan(store, scan);
        const fs::path folder = store.scanFolder(record.id, scan.id);
        if (const Organ organ = organOf(store, scan); !organ.isColon()) {
            entry.verdict = organ.name();
            entry.reason = "not a colon, and no part of this report";
            entry.skeleton_length_mm = 0;
        } else if (hasColon(folder)) {
            auto request = requestFor(SnapshotRequest::View::overview, record, scan, kOverviewWidth, kOverviewHeight);
            request.markers = numbered(read, markersOf(read, scan));
            entry.overview_picture = pictures / (scan.id + "-overview.png");
            viewer::renderSnapshot(viewer::PreparedScan::open(folder), request, entry.overview_picture);
        }
        entries.push_back(std::move(entry));
    }
    return entries;
}

std::vector<report::MarkerEntry> drawMarkers(CaseStore& store, const ReadCase& read,
                                             const std::vector<report::ScanEntry>& scans, const PictureFolder& pictures,
                                             Progress& progress)
{
    const viewer::Display display;
    std::vector<report::MarkerEntry> entries;
    std::set<std::string> told;
    const CaseRecord& record = read.record;
    const double all = double(read.markers.size());
    for (const report::ScanEntry& scan_entry : scans) {
        const ScanRecord& scan = scan_entry.scan;
        const std::vector<Marker> markers = markersOf(read, scan);
        if (markers.empty())
            continue;
        const auto prepared = openPrepared(store.scanFolder(record.id, scan.id));
        const ColonPartRanges parts = partsOf(store, scan);
        for (const Marker& marker : markers) {
            progress.check();
            progress.report(double(entries.size()) / all, "pictures of marker " + marker.id);
            report::MarkerEntry entry{.marker = marker, .scan_label = labelOf(scan)};
            entry.part_name = partNameAt(parts, marker.station_mm);
            if (prepared)
                drawPictures(*prepared, {record, scan}, pictures, entry);
            told.insert(marker.id);
            entries.push_back(std::move(entry));
        }
    }
    // A report never leaves a marker out, wherever its scan has gone.
    for (const Marker& marker : read.markers)
        if (!told.contains(marker.id))
            entries.push_back({.marker = marker, .scan_label = "scan " + marker.scan_id + ", which is not there"});
    return entries;
}

}  // namespace vicon::app
