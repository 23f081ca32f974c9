#include "report_pictures.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <future>
#include <optional>
#include <set>

#include "vicon/cases/bridges.h"
#include "vicon/cases/organs.h"
#include "vicon/cases/placing.h"
#include "vicon/cases/step_results.h"
#include "vicon/core/error.h"
#include "vicon/viewer/model/orientation.h"
#include "vicon/viewer/scene/measures_picture.h"
#include "vicon/viewer/scene/snapshot.h"

using vicon::viewer::SnapshotRequest;
using vicon::viewer::SnapshotView;

namespace vicon::app {
namespace {

// Printed 242 points wide: a printer has 300 pixels to the inch.
constexpr int kSlicesWidth = 1008, kSlicesHeight = 756;
constexpr int kMeasuresSide = 440;
constexpr double kMeasuresTextRatio = 1.6;  // so that words are read where they are printed
// Below the wall: densities of voxels of 0.7 mm and more, so that rays three pixels apart miss nothing.
constexpr const char* kBelowTheWall = "biopsy";
// The blurred edge from gas to tissue passes fat's density: a look that begins at the surface shows it as fat; one that
// passes a lesion's middle shows the edge behind it so.
constexpr double kBelowDeep_mm = 2, kBelowOfSize = 0.25;
constexpr int kBelowCoarse = 3;
constexpr double kBelowRadius_px = 0.36 * kEndoscopicSide;
constexpr int kOverviewWidth = 900, kOverviewHeight = 1100;
constexpr double kOverviewTextRatio = 3.2;  // so that its words are read where it is printed 150 to 190 points wide

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

std::string labelOf(const ScanRecord& scan)
{
    return positionName(scan.series.patient_position) + " (series " + std::to_string(scan.series.number) + ")";
}

report::ScanEntry describeScan(CaseStore& store, const ScanRecord& scan)
{
    report::ScanEntry entry{.scan = scan};
    const StepResults results = resultsOf(store.steps(scan.case_id, scan.id));
    if (results.segment) {
        entry.verdict = results.segment->verdict;
        if (results.segment->given)
            entry.lumen_given = textOf(*results.segment->given);
        entry.organ_title = results.segment->organ_title;
        entry.confidence = results.segment->confidence;
        entry.reason = results.segment->reason;
    }
    if (results.skeleton)
        entry.skeleton_length_mm = results.skeleton->length_mm;
    if (results.quality)
        entry.quality = results.quality->quality;
    entry.parts = results.parts();
    entry.bridges = reviewedBridges(store, scan);
    return entry;
}

picture::SharedPicture shared(viewer::Picture drawn)
{
    return std::make_shared<const picture::Picture>(
        picture::Picture{drawn.width, drawn.height, 3, std::move(drawn.rgb)});
}

/// The pictures of one sight of a finding, from left to right.
struct Sight {
    picture::SharedPicture endoscopic, below, slices, measures;  ///< some may be none
    std::atomic<int> halves = 0;                                 ///< that are drawn

    std::vector<picture::SharedPicture> all() const
    {
        std::vector<picture::SharedPicture> pictures{endoscopic, below, slices, measures};
        std::erase(pictures, nullptr);
        return pictures;
    }
};

/// A scan's finding pictures. OpenGL's are drawn on the thread that asks, all others meanwhile on a second one.
class FindingPictures {
public:
    FindingPictures(const ReadCase& read, const viewer::PreparedScan& prepared,
                    std::unique_ptr<viewer::KnownSnapshots> sights, const ScanRecord& scan, const PicturesMade& made)
        : read_(read), prepared_(prepared), sights_(std::move(sights)), scan_(scan), made_(made)
    {
    }

    /// @param entries of all the scan's markers, by station
    /// @param each is told of every finding before it is drawn; what it throws ends the drawing
    void draw(const std::vector<report::MarkerEntry*>& entries, const std::function<void(const Marker&)>& each)
    {
        std::atomic<bool> given_up = false;
        std::vector<Sight> sights(entries.size());
        const auto drawn = [&](std::size_t n) {
            if (++sights[n].halves == 2)
                made_.marker(entries[n]->marker.id, sights[n].all());
        };
        auto others = std::async(std::launch::async, [&] {
            for (std::size_t n = 0; n < entries.size() && !given_up; ++n) {
                drawOthers(*entries[n], sights[n]);
                drawn(n);
            }
        });
        try {
            for (std::size_t n = 0; n < entries.size(); ++n) {
                each(entries[n]->marker);
                drawEndoscopic(*entries[n], n, sights[n]);
                drawn(n);
            }
        } catch (...) {
            given_up = true;
            throw;
        }
        others.get();
    }

private:
    picture::SharedPicture made(const std::string& name, viewer::Picture drawn) const
    {
        picture::SharedPicture picture = shared(std::move(drawn));
        made_.picture(name, picture);
        return picture;
    }

    void drawEndoscopic(report::MarkerEntry& entry, std::size_t place, Sight& sight)
    {
        const Marker& marker = entry.marker;
        viewer::DrawnSnapshot seen = sights_->draw(place, {marker}, {});
        entry.endoscopic_picture = marker.id + "-endo";
        sight.endoscopic = made(entry.endoscopic_picture, std::move(seen.picture));
        const viewer::Pose& pose = seen.place.pose;
        entry.seen_from = "towards " + viewer::sideName(pose.forward) + ", " +
                          std::to_string(std::lround(distance(pose.eye_mm, marker.position_mm))) + " mm away";
        if (prepared_.quantity() == Quantity::signal)  // what lies below the wall is told by densities
            return;
        viewer::PeelRequest below;
        below.preset = kBelowTheWall;
        below.options.offset_mm = depthBelow_mm(read_, marker.id);
        below.middle_only = true;
        below.coarse = kBelowCoarse;
        below.circle_px = kBelowRadius_px;
        entry.below_picture = marker.id + "-below";  // without a ring, which would lie over what is seen
        sight.below = made(entry.below_picture, sights_->draw(place, {}, below).picture);
    }

    void drawOthers(report::MarkerEntry& entry, Sight& sight) const
    {
        const Marker& marker = entry.marker;
        const auto slices = markerPicture(SnapshotView::slices, scan_, marker, kSlicesWidth, kSlicesHeight);
        entry.slices_picture = marker.id + "-slices";
        sight.slices = made(entry.slices_picture, viewer::drawSnapshot(prepared_, slices).picture);
        if (auto measures =
                viewer::measuresPicture(prepared_, marker, captionOf(scan_), kMeasuresSide, kMeasuresTextRatio)) {
            entry.measures_picture = marker.id + "-measures";
            sight.measures = made(entry.measures_picture, std::move(*measures));
        }
    }

    const ReadCase& read_;
    const viewer::PreparedScan& prepared_;
    const std::unique_ptr<viewer::KnownSnapshots> sights_;
    const ScanRecord& scan_;
    const PicturesMade& made_;
};

}  // namespace

double depthBelow_mm(const ReadCase& read, const std::string& marker_id)
{
    double depth_mm = kBelowDeep_mm;
    for (const auto& [finding, facts] : read.findings)
        if (std::find(finding.markers.begin(), finding.markers.end(), marker_id) != finding.markers.end())
            depth_mm = std::min(depth_mm, kBelowOfSize * facts.size_mm.value_or(depth_mm / kBelowOfSize));
    return depth_mm;
}

std::vector<report::ScanEntry> drawScans(CaseStore& store, const ReadCase& read, ReportScans& scans, Progress& progress,
                                         const PicturesMade& made)
{
    const CaseRecord& record = read.record;
    std::vector<report::ScanEntry> entries;
    for (const ScanRecord& scan : store.scans(record.id)) {
        if (scan.role != ScanRole::scan && markersOf(read, scan).empty())
            continue;
        progress.check();
        progress.report(0, "overview of " + scan.id);
        report::ScanEntry entry = describeScan(store, scan);
        if (const Organ organ = organOf(store, scan); !organ.isColon()) {
            entry.verdict = Verdict::found;
            entry.organ_title = organ.name();
            entry.reason = "not a colon, and no part of this report";
            entry.skeleton_length_mm = 0;
        } else if (const viewer::PreparedScan* prepared = scans.find(scan.id)) {
            auto request = reportPicture(SnapshotView::overview, scan, kOverviewWidth, kOverviewHeight);
            request.markers = numbered(read, markersOf(read, scan));
            request.pixel_ratio = kOverviewTextRatio;
            entry.overview_picture = scan.id + "-overview";
            made.picture(entry.overview_picture, shared(viewer::drawSnapshot(*prepared, request).picture));
        }
        entries.push_back(std::move(entry));
    }
    return entries;
}

std::vector<report::MarkerEntry> drawMarkers(CaseStore& store, const ReadCase& read,
                                             const std::vector<report::ScanEntry>& entries_of_scans, ReportScans& scans,
                                             Progress& progress, const PicturesMade& made)
{
    std::vector<report::MarkerEntry> entries;
    entries.reserve(read.markers.size());
    std::set<std::string> told;
    double drawn = 0;
    for (const report::ScanEntry& scan_entry : entries_of_scans) {
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
        if (const viewer::PreparedScan* prepared = scans.find(scan.id))
            FindingPictures(read, *prepared, scans.sights(scan.id), scan, made)
                .draw(of_scan, [&](const Marker& marker) {
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
