#include "report_scans.h"

#include <algorithm>

namespace fs = std::filesystem;
using vicon::viewer::SnapshotRequest;
using vicon::viewer::SnapshotView;

namespace vicon::app {
namespace {

constexpr double kTextRatio = 2.0;  // so that words are read where they are printed

bool hasColon(const fs::path& folder)
{
    return fs::exists(folder / "cells.vtp") && fs::exists(folder / "skeleton.vtp");
}

}  // namespace

std::vector<Marker> markersOf(const ReadCase& read, const ScanRecord& scan)
{
    std::vector<Marker> markers = read.markers;
    std::erase_if(markers, [&](const Marker& m) { return m.scan_id != scan.id; });
    std::stable_sort(markers.begin(), markers.end(),
                     [](const Marker& a, const Marker& b) { return a.station_mm < b.station_mm; });
    return markers;
}

viewer::Caption captionOf(const ScanRecord& scan)
{
    return {.named = false, .lossy = scan.series.lossy};
}

SnapshotRequest reportPicture(SnapshotView view, const ScanRecord& scan, int width, int height)
{
    SnapshotRequest request;
    request.view = view;
    request.caption = captionOf(scan);
    request.captioned = false;  // the page says it
    request.width = width;
    request.height = height;
    return request;
}

SnapshotRequest markerPicture(SnapshotView view, const ScanRecord& scan, const Marker& marker, int width, int height)
{
    SnapshotRequest request = reportPicture(view, scan, width, height);
    request.pixel_ratio = kTextRatio;
    request.look_at_mm = marker.position_mm;
    request.station_mm = marker.station_mm;
    request.markers = {marker};
    return request;
}

ReportScans::ReportScans(CaseStore& store, const ReadCase& read, const Progress& wanted) : wanted_(wanted)
{
    for (const ScanRecord& scan : store.scans(read.record.id)) {
        const fs::path folder = store.scanFolder(read.record.id, scan.id);
        if (!hasColon(folder))
            continue;
        Scan& added = *scans_.emplace_back(std::make_unique<Scan>());
        added.id = scan.id;
        added.folder = folder;
        for (const Marker& marker : markersOf(read, scan))
            added.requests.push_back(markerPicture(SnapshotView::endo, scan, marker, kEndoscopicSide, kEndoscopicSide));
    }
    making_ = std::async(std::launch::async, [this] { makeReady(); });
}

ReportScans::~ReportScans()
{
    wanted_.giveUp();
}

void ReportScans::makeReady()
{
    for (const auto& scan : scans_) {
        if (scan->requests.empty())
            continue;
        try {
            wanted_.check();  // else the next scan would still be read
            scan->sights.set_value(std::make_unique<viewer::KnownSnapshots>(*find(scan->id), scan->requests, &wanted_));
        } catch (...) {
            scan->sights.set_exception(std::current_exception());
        }
    }
}

ReportScans::Scan* ReportScans::scanOf(const std::string& scan_id)
{
    const auto found =
        std::find_if(scans_.begin(), scans_.end(), [&](const auto& scan) { return scan->id == scan_id; });
    return found == scans_.end() ? nullptr : found->get();
}

const viewer::PreparedScan* ReportScans::find(const std::string& scan_id)
{
    Scan* scan = scanOf(scan_id);
    if (!scan)
        return nullptr;
    const std::lock_guard lock(mutex_);
    if (!scan->prepared)
        scan->prepared = viewer::PreparedScan::open(scan->folder);
    return &*scan->prepared;
}

std::unique_ptr<viewer::KnownSnapshots> ReportScans::sights(const std::string& scan_id)
{
    return scanOf(scan_id)->sights.get_future().get();
}

}  // namespace vicon::app
