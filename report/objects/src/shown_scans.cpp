#include "shown_scans.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <future>

#include "vicon/dicom/dicom_setup.h"
#include "vicon/scan_files/skeleton_file.h"

namespace fs = std::filesystem;

namespace vicon::report {
namespace {

/// What is known of a scan before anything is read: the store's connection belongs to the thread that asks.
struct ToRead {
    ScanRecord scan;
    fs::path folder;
    std::vector<InstanceRecord> instances;
    std::vector<FindingSight> sights;
    bool centreline = false, lumen = false;
    std::optional<LumenOrigin> given;  ///< where the lumen came from; absent: VICON found it
};

bool has(const std::vector<ObjectKind>& kinds, ObjectKind kind)
{
    return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

std::vector<ToRead> toRead(CaseStore& store, const ReadCase& read, const std::vector<ObjectKind>& kinds)
{
    std::vector<ToRead> all;
    for (const ScanRecord& scan : read.scans) {
        ToRead one{.scan = scan,
                   .folder = store.scanFolder(scan.case_id, scan.id),
                   .instances = {},
                   .sights = {},
                   .given = {}};
        for (const auto& [finding, facts] : read.findings)
            std::copy_if(facts.sights.begin(), facts.sights.end(), std::back_inserter(one.sights),
                         [&](const FindingSight& sight) { return sight.scan_id == scan.id; });
        const bool prepared = scan.role == ScanRole::scan && !scan.series.frame_of_reference_uid.empty() &&
                              fs::exists(one.folder / "inside.mha") && fs::exists(one.folder / "skeleton.vtp");
        one.centreline = prepared && has(kinds, ObjectKind::measurements);
        one.lumen = prepared && has(kinds, ObjectKind::lumen);
        if (one.lumen || !one.sights.empty())
            one.instances = store.instances(scan.case_id, scan.id);
        if (const auto given = read.given_lumens.find(scan.id); given != read.given_lumens.end())
            one.given = given->second;
        all.push_back(std::move(one));
    }
    return all;
}

Centreline centrelineOf(const ScanRecord& scan, const fs::path& folder)
{
    const Skeleton skeleton = scan_files::readSkeleton(folder / "skeleton.vtp");
    Centreline line{.scan = scan, .points_mm = {}, .length_mm = skeleton.length_mm()};
    for (const SkeletonPiece& piece : skeleton.pieces)
        for (const SkeletonPoint& point : piece.points)
            if (line.points_mm.empty() || line.points_mm.back() != point.position_mm)
                line.points_mm.push_back(point.position_mm);
    return line;
}

ShownScans::Parts readAll(const std::vector<ToRead>& scans)
{
    ShownScans::Parts parts;
    for (const auto& [scan, folder, instances, sights, centreline, lumen, given] : scans) {
        const SourceImages images(folder / "dicom", instances);
        for (const FindingSight& sight : sights)
            if (const auto image = images.nearest(sight.position_mm))
                parts.findings.emplace(sight.marker_id, *image);
        if (centreline)
            if (Centreline line = centrelineOf(scan, folder); line.points_mm.size() > 1)
                parts.centrelines.push_back(std::move(line));
        if (lumen)
            if (auto drawn = drawLumen(scan, images.planes(), folder, given))
                parts.lumens.emplace(scan.id, std::move(drawn));
    }
    return parts;
}

}  // namespace

struct ShownScans::Work {
    std::future<Parts> begun;
    std::optional<Parts> done;
};

ShownScans::ShownScans(CaseStore& store, const ReadCase& read, const std::vector<ObjectKind>& kinds)
    : work_(std::make_unique<Work>())
{
    setUpDicom();  // on this thread, as it sets the environment
    work_->begun = std::async(std::launch::async, readAll, toRead(store, read, kinds));
}

ShownScans::~ShownScans() = default;

ShownScans::Parts& ShownScans::parts()
{
    if (!work_->done)
        work_->done = work_->begun.get();
    return *work_->done;
}

}  // namespace vicon::report
