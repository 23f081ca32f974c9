#include "coverage/coverage_keeper.h"

#include <unistd.h>

#include <algorithm>

#include "vicon/core/file.h"
#include "vicon/scan_files/cells_file.h"

namespace vicon::viewer {
namespace {

constexpr const char *kSearch = "unseen", *kSum = "reviewed";

/// Two readers of one case each have their own eyes.
std::filesystem::path fileFor(const std::filesystem::path& scan_folder)
{
    const std::string name = scan_folder.filename().string() + "-user" + std::to_string(getuid()) + ".seen";
    return scan_folder.parent_path() / "reading" / name;
}

ReviewedScan reviewedOf(const ScanRecord& scan, const std::vector<std::uint32_t>& triangles, const Coverage& coverage,
                        const Progress& wanted)
{
    const std::vector<double> areas_mm2 = unseenAreas_mm2(triangles, coverage, &wanted);
    const auto missed =
        std::count_if(areas_mm2.begin(), areas_mm2.end(), [](double area) { return area >= kMissedRegion_mm2; });
    return {scan, coverage.seenArea_mm2(), coverage.wholeArea_mm2(), int(missed)};
}

/// A scan that cannot be read says so; the others are told all the same.
ReviewedScan reviewedOf(const ScanToReview& which, const Progress& wanted)
try {
    if (which.open)
        return reviewedOf(which.scan, which.open->files.cells().triangles, which.open->coverage.coverage(), wanted);
    const CellSurface cells = scan_files::readCells(which.folder / "cells.vtp");
    ScanCoverage kept(triangleAreas_mm2(cells.points_mm, cells.triangles));
    CoverageKeeper::restore(kept, which.folder);
    return reviewedOf(which.scan, cells.triangles, kept.coverage(), wanted);
} catch (const std::exception&) {
    wanted.check();
    return {which.scan};
}

}  // namespace

CoverageKeeper::CoverageKeeper(QObject* parent) : QObject(parent)
{
    connect(worker_.worker(), &Worker::failed, this, &CoverageKeeper::failed);
}

void CoverageKeeper::restore(ScanCoverage& seen, const std::filesystem::path& scan_folder)
{
    if (std::error_code none; std::filesystem::exists(fileFor(scan_folder), none))
        seen.unpack(readFile(fileFor(scan_folder)));  // of an older surface: the reader begins anew
}

void CoverageKeeper::findUnseen(std::shared_ptr<OpenScan> scan, double least_mm2)
{
    worker_.giveUp(kSearch);
    worker_.post(kSearch, [this, scan = std::move(scan), least_mm2](Written&, const Progress& wanted) -> Worker::Work {
        const auto& cells = scan->files.cells();
        auto patches = unseenPatches(cells.points_mm, cells.triangles, scan->coverage.coverage(),
                                     scan->files.skeleton(), scan->files.frames(), scan->lumen, least_mm2, &wanted);
        return [this, scan, patches = std::move(patches)] { emit found(patches, scan); };
    });
}

void CoverageKeeper::sumUp(std::vector<ScanToReview> scans)
{
    worker_.giveUp(kSum);
    worker_.post(kSum, [this, scans = std::move(scans)](Written&, const Progress& wanted) -> Worker::Work {
        std::vector<ReviewedScan> reviewed;
        for (const ScanToReview& scan : scans) {
            wanted.check();
            reviewed.push_back(reviewedOf(scan, wanted));
        }
        return [this, reviewed] { emit summedUp(reviewed); };
    });
}

void CoverageKeeper::save(std::shared_ptr<OpenScan> scan)
{
    worker_.postAlways([scan = std::move(scan)](Written& written) -> Worker::Work {
        std::string bytes = scan->coverage.packed();
        const auto file = fileFor(scan->files.folder());
        if (bytes == written[file] || !std::filesystem::exists(scan->files.folder()))  // the case may have been deleted
            return {};
        makePrivateFolder(file.parent_path());
        replaceFile(file, bytes);
        written[file] = std::move(bytes);
        return {};
    });
}

}  // namespace vicon::viewer
