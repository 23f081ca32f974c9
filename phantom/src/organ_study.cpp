#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "dicom_writer.h"
#include "imaging.h"
#include "tubes.h"
#include "uid.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/phantom/organ_phantom.h"
#include "vicon/scan_files/volume_file.h"

namespace fs = std::filesystem;

namespace vicon::phantom {
namespace {

constexpr double kWidth_mm = 300, kChest_mm = 280, kTrunk_mm = 400;
constexpr double kLumenBlur_mm = 0.65;
constexpr double kThinnestWall_mm = 1.2, kWallShare = 0.2;  // of the radius
constexpr double kOrganWall_hu = 30, kAir_hu = -1000, kContrast_hu = 320;

bool isAirway(const OrganPhantomOptions& options)
{
    if (options.organ != "airway" && options.organ != "aorta")
        throw Error(ErrorCode::wrong_use, "there is no phantom of '" + options.organ + "'", "--organ",
                    "name airway or aorta");
    return options.organ == "airway";
}

Grid gridFor(const OrganPhantomOptions& options)
{
    const std::array<double, 3> extent_mm{kWidth_mm, kWidth_mm, isAirway(options) ? kChest_mm : kTrunk_mm};
    Grid grid;
    grid.size = options.size;
    grid.origin_mm = {};
    for (std::size_t a = 0; a < 3; ++a) {
        // Numbers that DICOM's decimal strings hold exactly.
        grid.spacing_mm[a] = std::round(extent_mm[a] / grid.size[a] * 1e4) / 1e4;
        grid.origin_mm += grid.axis[a] * -(grid.spacing_mm[a] * (grid.size[a] - 1) / 2);
    }
    return grid;
}

SkeletonTree withWall(SkeletonTree tree)
{
    for (SkeletonBranch& branch : tree.branches)
        for (SkeletonPoint& point : branch.points)
            point.radius_mm += std::max(kThinnestWall_mm, kWallShare * point.radius_mm);
    return tree;
}

/// How much of a voxel lies inside a surface at a signed distance.
double share(double distance_mm, double voxel_mm)
{
    return std::clamp(0.5 - distance_mm / voxel_mm, 0.0, 1.0);
}

nlohmann::json describe(const OrganTruth& truth)
{
    nlohmann::json branches = nlohmann::json::array();
    for (const SkeletonBranch& branch : truth.tree.branches) {
        nlohmann::json one = {{"parent", branch.parent}, {"generation", branch.generation}};
        for (const SkeletonPoint& p : branch.points) {
            one["points_mm"].push_back({p.position_mm.x, p.position_mm.y, p.position_mm.z});
            one["station_mm"].push_back(p.station_mm);
            one["radius_mm"].push_back(p.radius_mm);
        }
        branches.push_back(std::move(one));
    }
    const auto voxels = std::count(truth.inside.voxels.begin(), truth.inside.voxels.end(), kGas);
    return {{"branches", branches},
            {"total_length_mm", truth.tree.totalLength_mm()},
            {"volume_ml", double(voxels) * truth.inside.grid.voxelVolume_mm3() / 1000}};
}

}  // namespace

OrganScan makeOrganScan(const OrganPhantomOptions& options, Progress& progress)
{
    const bool airway = isAirway(options);
    const Grid grid = gridFor(options);
    OrganScan scan;
    scan.truth.tree = airway ? drawAirway(options.seed) : drawAorta(options.seed);
    progress.report(0, "tubes");
    const FieldVolume lumen_mm = tubesField(grid, scan.truth.tree, 8),
                      wall_mm = tubesField(grid, withWall(scan.truth.tree), 8);
    progress.report(0.4, "body");
    const double voxel_mm = std::cbrt(grid.voxelVolume_mm3());
    scan.truth.inside = InsideVolume(grid);
    HuVolume scene(grid);
    for (std::size_t n = 0; n < scene.voxels.size(); ++n) {
        if (n % (1U << 20) == 0)
            progress.check();
        const Point3 p = grid.pointAt(grid.indexOf(n));
        const double inside_mm = double(lumen_mm.voxels[n]);
        double hu = airway ? chestHu(p) : trunkHu(p, inside_mm);
        hu += (kOrganWall_hu - hu) * share(double(wall_mm.voxels[n]), voxel_mm);
        hu += ((airway ? kAir_hu : kContrast_hu) - hu) * share(inside_mm, voxel_mm);
        scene.voxels[n] = std::int16_t(std::lround(hu));
        scan.truth.inside.voxels[n] = inside_mm < 0 ? kGas : kOutside;
    }
    progress.report(0.7, "blur and noise");
    scan.hu = imageScene(scene, {options.seed, kLumenBlur_mm, options.noise_hu}, progress);
    progress.report(1, "scan");
    return scan;
}

void writeOrganStudy(const fs::path& out, const OrganPhantomOptions& options, Progress& progress)
{
    std::error_code problem;
    if (fs::exists(out, problem) && (!fs::is_directory(out, problem) || !fs::is_empty(out, problem)))
        throw Error(ErrorCode::wrong_use, "the folder for the phantom is not empty", out.string(),
                    "name a new or an empty folder");
    const OrganScan scan = makeOrganScan(options, progress);
    makePrivateFolder(out);
    const std::string seed = std::to_string(options.seed);
    const auto& size = options.size;
    StudyHeader study;
    study.key = Random(options.seed, options.organ + std::to_string(size[0]) + "x" + std::to_string(size[1]) + "x" +
                                         std::to_string(size[2]))
                    .bits();
    study.study_uid = uidFor(study.key, "study");
    study.patient_name = "Phantom^" + options.organ + seed;
    study.patient_id = "PHANTOM-" + options.organ + "-" + seed;
    study.birth_date = "19500115";
    study.sex = "F";
    study.date = "20240115";
    study.accession_number = "P" + seed;
    study.study_id = seed.substr(0, 16);
    const bool airway = isAirway(options);
    study.description = airway ? "CT CHEST" : "CT ANGIOGRAPHY";
    study.body_part = airway ? "CHEST" : "AORTA";
    study.protocol = airway ? "CHEST" : "AORTA";
    const SeriesHeader series{2, uidFor(study.key, options.organ), options.organ + " soft", "HFS"};
    writeSeries(out / ("series-2-" + options.organ), study, series, scan.hu, progress);
    scan_files::writeVolume(out / ("truth-" + options.organ + "-inside.mha"), scan.truth.inside,
                            scan_files::Packing::zlib);
    nlohmann::json truth = describe(scan.truth);
    truth["organ"] = options.organ;
    truth["scan"] = series.uid;
    truth["study"] = study.study_uid;
    truth["noise_hu"] = options.noise_hu;
    replaceFile(out / ("truth-" + options.organ + ".json"), truth.dump() + "\n");
    progress.report(1, "study");
}

}  // namespace vicon::phantom
