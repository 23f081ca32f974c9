#include "reading_store.h"

#include <unistd.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "test_colon.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/scan_files/cells_file.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/support/support.h"
#include "vicon/viewer/model/scan_coverage.h"

namespace fs = std::filesystem;

namespace vicon::viewer::test {

void makeStore(const fs::path& folder)
{
    CaseStore store(folder);
    CaseRecord a_case;
    a_case.id = kCase;
    a_case.patient = {"PH-1", "Phantom^Anna", "19600102", "F"};
    a_case.study.uid = "1.2.3";
    a_case.study.date = "20260102";
    CaseRecord failed = a_case;
    failed.id = kFailedCase;
    failed.patient = {"PH-2", "Other^Bert", "19500203", "M"};
    failed.study.uid = "1.2.4";
    const auto scan = [&](const CaseRecord& of, const char* id, const char* position, int number) {
        ScanRecord record;
        record.id = id;
        record.case_id = of.id;
        record.series.uid = of.study.uid + "." + std::to_string(number);
        record.series.number = number;
        record.series.patient_position = position;
        fs::create_directories(store.scanFolder(of.id, id));
        store.addScan(of, record, {}, false);
    };
    scan(a_case, kSupine, "HFS", 1);
    scan(a_case, kProne, "HFP", 2);
    scan(failed, "s3", "HFS", 1);
    const TestColon colon;
    for (const char* id : {kSupine, kProne}) {
        colon.write(store.scanFolder(kCase, id));
        store.writeScanFile(kCase, id);
    }
}

SeenWall reviewAllBut(const fs::path& store, const char* scan, const std::vector<double>& stations_mm)
{
    constexpr double kMissed_mm = 12;
    const fs::path folder = CaseStore(store).scanFolder(kCase, scan);
    const CellSurface cells = scan_files::readCells(folder / "cells.vtp");
    const Skeleton path = scan_files::readSkeleton(folder / "skeleton.vtp");
    const auto corner = [&](std::size_t triangle) { return cells.point(cells.triangles[3 * triangle]); };
    std::vector<Point3> missed;
    for (const double station_mm : stations_mm) {
        const Point3 on_path = path.at(station_mm).position_mm;
        std::size_t nearest = 0;
        for (std::size_t t = 0; t < cells.triangleCount(); ++t)
            if (distance(corner(t), on_path) < distance(corner(nearest), on_path))
                nearest = t;
        missed.push_back(corner(nearest));
    }
    std::vector<std::uint32_t> seen;
    for (std::size_t t = 0; t < cells.triangleCount(); ++t)
        if (std::all_of(missed.begin(), missed.end(),
                        [&](Point3 place) { return distance(corner(t), place) > kMissed_mm; }))
            seen.push_back(std::uint32_t(t));
    ScanCoverage coverage(triangleAreas_mm2(cells.points_mm, cells.triangles));
    coverage.see(seen);
    const fs::path file =
        folder.parent_path() / "reading" / (folder.filename().string() + "-user" + std::to_string(getuid()) + ".seen");
    fs::create_directories(file.parent_path());
    replaceFile(file, coverage.packed());
    return {coverage.seenArea_mm2(), coverage.coverage().wholeArea_mm2()};
}

void sayOrgan(const fs::path& scan_folder, const std::string& organ)
{
    const auto file = scan_folder / "scan.json";
    auto scan = nlohmann::json::parse(readFile(file));
    scan["organ"] = organ;
    scan["steps"]["segment"] = {
        {"version", 1}, {"digest", ""},  {"parameters", nlohmann::json::object()}, {"result", {{"organ", organ}}},
        {"seconds", 0}, {"finished", ""}};
    replaceFile(file, scan.dump());
}

namespace {

/// The way without what a cut took of its caecal end.
void cutShort(Skeleton& path)
{
    constexpr double kCut_mm = 40;
    const double end_mm = path.length_mm() - kCut_mm;
    std::vector<SkeletonPoint>& points = path.pieces.back().points;
    while (points.back().station_mm > end_mm)
        points.pop_back();
}

/// What a reader said.
struct Said {
    std::mutex mutex;
    std::string queued;  // the scan
    std::map<std::string, Corrections> corrections;
    std::optional<BridgeReview> review;
};

void addCorrections(ReadingServices& services, const std::shared_ptr<Said>& state)
{
    services.corrections = [state](CaseStore&, const ScanRecord& scan) {
        const std::lock_guard lock(state->mutex);
        return state->corrections[scan.id];
    };
    services.correct = [state](CaseStore&, const ScanRecord& scan, const Corrections& before,
                               const Corrections& after) {
        const std::lock_guard lock(state->mutex);
        if (state->corrections[scan.id] != before)
            throw Error(ErrorCode::bad_input,
                        "what was corrected in this scan was changed by another reader meanwhile");
        state->corrections[scan.id] = after;
        state->queued = scan.id;
    };
}

void addBridges(ReadingServices& services, const std::shared_ptr<Said>& state)
{
    services.bridges = [state](CaseStore& store, const ScanRecord& scan) {
        const Skeleton path = scan_files::readSkeleton(store.scanFolder(scan.case_id, scan.id) / "skeleton.vtp");
        if (path.empty())
            return std::vector<ReviewedBridge>{};
        const std::lock_guard lock(state->mutex);
        const Bridge bridge{path.at(180).position_mm, path.at(200).position_mm, {}, 20, 0.7, "a short gap", true};
        return std::vector<ReviewedBridge>{{bridge, state->review}};
    };
    services.review_bridge = [state](CaseStore&, const ScanRecord&, const ReviewedBridge& bridge) {
        const std::lock_guard lock(state->mutex);
        state->review = bridge.review;
        if (state->review && state->review->by.empty()) {
            state->review->by = "anna";
            state->review->at = "2026-01-03";
        }
    };
}

/// The queue's work, without a pipeline: the scan is written anew, of larger voxels; where it was cut, the way is
/// shorter.
void addWork(ReadingServices& services, const std::shared_ptr<Said>& state)
{
    services.work = [state](CaseStore& store, const std::atomic<bool>&) {
        constexpr double kCoarser_mm = 3;
        std::string scan;
        bool corrected = false, cut = false;
        {
            const std::lock_guard lock(state->mutex);
            scan = state->queued;
            corrected = state->corrections[scan] != Corrections{};
            cut = !state->corrections[scan].cut.empty();
        }
        TestColon colon = corrected ? TestColon(storages().front(), kCoarser_mm) : TestColon();
        if (cut)
            cutShort(colon.skeleton);
        colon.write(store.scanFolder(kCase, scan));
        const std::lock_guard lock(state->mutex);
        state->queued.clear();
    };
    services.worklist = [state, before = services.worklist](CaseStore& store, const WorklistPageWanted& wanted) {
        WorklistPage page = before(store, wanted);
        const std::lock_guard lock(state->mutex);
        for (WorklistCase& row : page.cases)
            for (WorklistScan& scan : row.scans)
                if (scan.record.id == state->queued)
                    scan.state = WorkState::running;
        return page;
    };
}

void addMarkerFiles(ReadingServices& services)
{
    services.import_markers = [place = services.place](CaseStore& store, const std::string& case_id,
                                                       const fs::path& file, Progress& wanted) {
        std::vector<MarkerEdit> edits;
        const auto all = nlohmann::json::parse(readFile(file));
        for (const auto& entry : all.at("markers")) {
            wanted.check();
            const Marker marker = place(store, case_id, markerFromJson(entry));
            edits.push_back({store.requireMarker(case_id, marker.id), marker});
        }
        return edits;
    };
    services.renew_places = [place = services.place](CaseStore& store, const std::string& case_id) {
        std::vector<std::string> lost;
        for (const Marker& marker : store.markers(case_id))
            try {
                store.editMarkers(case_id, {{marker, place(store, case_id, marker)}});
            } catch (const Error& e) {
                if (e.code() != ErrorCode::bad_input)
                    throw;
                lost.push_back(marker.id);
            }
        return lost;
    };
}

SigningOptions signedHere()
{
    std::string account = support::runCommand("id -un").output;
    account.erase(account.find_last_not_of('\n') + 1);
    return {{account}, {}};
}

void addReporting(ReadingServices& services)
{
    ReportServices& reporting = services.reporting;
    reporting.texts.technique = "Low dose, tagged.";
    reporting.known = [](CaseStore&, const std::string&) {
        return KnownStudy{.technique = "CT colonography, supine (120 kV).", .fluid = "supine 20 ml (2 %)"};
    };
    reporting.text = [](CaseStore&, const std::string& case_id) { return "the report of " + case_id; };
    reporting.pdf = [](CaseStore&, const std::string&, Progress&) { return readFile(VICON_A_PDF); };
    reporting.sign = [](CaseStore& store, const std::string& case_id, Progress&) {
        const VersionDraft draft = draftVersion(store, signedHere(), case_id, true, "test");
        return keepVersion(store, case_id, draft, readFile(VICON_A_PDF));
    };
    reporting.amend = [](CaseStore& store, const std::string& case_id, const std::string& reason) {
        beginAmendment(store, signedHere(), case_id, reason);
    };
    reporting.cancel_amendment = [](CaseStore& store, const std::string& case_id) {
        cancelAmendment(store, signedHere(), case_id);
    };
}

}  // namespace

ReadingServices servicesFor(const fs::path& folder)
{
    ReadingServices services;
    services.store = folder;
    const auto retried = std::make_shared<std::atomic<bool>>(false);
    services.worklist = [retried](CaseStore& store, WorklistPageWanted wanted) {
        const auto wanted_state = std::exchange(wanted.state, {});
        WorklistPage page = makeWorklistPage(store, {}, wanted);
        std::vector<WorklistCase> rows;
        for (const WorklistCase& listed : page.cases) {
            const CaseRecord& record = listed.record;
            const bool ready = record.id == kCase;
            const WorkState state = ready ? WorkState::done : *retried ? WorkState::queued : WorkState::failed;
            const std::string reason = state == WorkState::failed ? "the series has a gap of 40 mm" : "";
            WorklistCase row{record, state, reason, ready ? 1.0 : 0.0, int(store.markers(record.id).size()), 0, {}};
            for (const ScanRecord& scan : store.scans(record.id))
                row.scans.push_back({scan, state, "", row.progress, reason, store.scanFolder(record.id, scan.id),
                                     ready ? "radius 18 mm, fluid 7 %, sigmoid collapsed over 38 mm" : "",
                                     scan.id != kProne});
            if (!wanted_state || row.state == *wanted_state)
                rows.push_back(row);
        }
        page.cases = rows;
        return page;
    };
    services.retry = [retried](CaseStore&, const std::string&) { *retried = true; };
    services.place = [](CaseStore& store, const std::string& case_id, Marker marker) {
        const Skeleton path = scan_files::readSkeleton(store.scanFolder(case_id, marker.scan_id) / "skeleton.vtp");
        const SkeletonFoot foot = path.nearest(marker.position_mm);
        constexpr double kFar_mm = 60;
        if (!path.empty() && foot.distance_mm > kFar_mm)
            throw Error(ErrorCode::bad_input, "the point is not in the colon");
        marker.station_mm = foot.station_mm;
        marker.from_caecum_mm = path.length_mm() - foot.station_mm;
        marker.fraction = path.empty() ? 0 : foot.station_mm / path.length_mm();
        return marker;
    };
    services.report = [](CaseStore& store, const std::string& case_id, Progress&) {
        const fs::path file = store.caseFolder(case_id) / "1.pdf";
        replaceFile(file, "a report");
        return file;
    };
    const auto said = std::make_shared<Said>();
    addCorrections(services, said);
    addBridges(services, said);
    addWork(services, said);
    addMarkerFiles(services);
    addReporting(services);
    services.priors = {{},
                       [](CaseStore&, const std::string&) { return PriorList{}; },
                       [](CaseStore&, const PriorReport&) { return std::vector<PriorScan>{}; }};
    return services;
}

}  // namespace vicon::viewer::test
