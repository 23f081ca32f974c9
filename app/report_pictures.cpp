#include "report_pictures.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <functional>
#include <future>
#include <optional>
#include <set>

#include "vicon/cases/bridges.h"
#include "vicon/cases/organs.h"
#include "vicon/cases/placing.h"
#include "vicon/cases/step_results.h"
#include "vicon/core/error.h"
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

/// What a picture says about its scan; the page says whose it is, and the heading of the picture which scan's.
viewer::Caption captionOf(const ScanRecord& scan)
{
    return {.named = false, .lossy = scan.series.lossy};
}

SnapshotRequest requestFor(SnapshotRequest::View view, const ScanRecord& scan, int width, int height)
{
    SnapshotRequest request;
    request.view = view;
    request.caption = captionOf(scan);
    request.width = width;
    request.height = height;
    request.lasting = false;
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

/// A scan's finding pictures. OpenGL's are drawn on the thread that asks, all others meanwhile on a second one.
class FindingPictures {
public:
    FindingPictures(const viewer::PreparedScan& prepared, const ScanRecord& scan, const PictureFolder& folder)
        : prepared_(prepared), endoscopic_(prepared), scan_(scan), folder_(folder)
    {
    }

    /// @param each is told of every finding before it is drawn; what it throws ends the drawing
    void draw(const std::vector<report::MarkerEntry*>& entries, const std::function<void(const Marker&)>& each)
    {
        std::atomic<bool> given_up = false;
        auto others = std::async(std::launch::async, [&] {
            for (report::MarkerEntry* entry : entries)
                if (!given_up)
                    drawOthers(*entry);
        });
        try {
            for (report::MarkerEntry* entry : entries) {
                each(entry->marker);
                drawEndoscopic(*entry);
            }
        } catch (...) {
            given_up = true;
            throw;
        }
        others.get();
    }

private:
    SnapshotRequest requestFor(SnapshotRequest::View view, const Marker& marker, int width, int height) const
    {
        auto request = app::requestFor(view, scan_, width, height);
        request.look_at_mm = marker.position_mm;
        request.station_mm = marker.station_mm;
        request.markers = {marker};
        return request;
    }

    void drawEndoscopic(report::MarkerEntry& entry)
    {
        const Marker& marker = entry.marker;
        entry.endoscopic_picture = folder_ / (marker.id + "-endo.png");
        endoscopic_.render(requestFor(SnapshotRequest::View::endo, marker, kEndoscopicSide, kEndoscopicSide),
                           entry.endoscopic_picture);
    }

    void drawOthers(report::MarkerEntry& entry) const
    {
        const Marker& marker = entry.marker;
        entry.slices_picture = folder_ / (marker.id + "-slices.png");
        const auto request = requestFor(SnapshotRequest::View::slices, marker, kSlicesWidth, kSlicesHeight);
        viewer::renderSnapshot(prepared_, request, entry.slices_picture);
        if (const auto measures = viewer::measuresPicture(prepared_, marker, captionOf(scan_), kMeasuresSide)) {
            entry.measures_picture = folder_ / (marker.id + "-measures.png");
            viewer::writePng(entry.measures_picture, *measures, request.lasting);
        }
    }

    const viewer::PreparedScan& prepared_;
    viewer::Snapshots endoscopic_;
    const ScanRecord& scan_;
    const PictureFolder& folder_;
};

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
            auto request = requestFor(SnapshotRequest::View::overview, scan, kOverviewWidth, kOverviewHeight);
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
    std::vector<report::MarkerEntry> entries;
    entries.reserve(read.markers.size());
    std::set<std::string> told;
    double drawn = 0;
    for (const report::ScanEntry& scan_entry : scans) {
        const ScanRecord& scan = scan_entry.scan;
        std::vector<report::MarkerEntry*> of_scan;
        const ColonPartRanges parts = partsOf(store, scan);
        for (const Marker& marker : markersOf(read, scan)) {
            told.insert(marker.id);
            entries.push_back(
                {.marker = marker, .scan_label = labelOf(scan), .part_name = partNameAt(parts, marker.station_mm)});
            of_scan.push_back(&entries.back());
        }
        if (of_scan.empty())
            continue;
        if (const auto prepared = openPrepared(store.scanFolder(scan.case_id, scan.id)))
            FindingPictures(*prepared, scan, pictures).draw(of_scan, [&](const Marker& marker) {
                progress.check();
                progress.report(drawn++ / double(read.markers.size()), "pictures of marker " + marker.id);
            });
    }
    // A report never leaves a marker out, wherever its scan has gone.
    for (const Marker& marker : read.markers)
        if (!told.contains(marker.id))
            entries.push_back({.marker = marker, .scan_label = "scan " + marker.scan_id + ", which is not there"});
    return entries;
}

}  // namespace vicon::app
