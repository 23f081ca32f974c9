#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "dicom_writer.h"
#include "imaging.h"
#include "stomach.h"
#include "tubes.h"
#include "uid.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/phantom/organ_phantom.h"
#include "vicon/scan_files/volume_file.h"

namespace fs = std::filesystem;

namespace vicon::phantom {
namespace {

constexpr double kWidth_mm = 300;
constexpr double kLumenBlur_mm = 0.65;
constexpr double kThinnestWall_mm = 1.2, kWallShare = 0.2;  // of the radius
constexpr double kStomachWall_mm = 4;
constexpr double kOrganWall_hu = 30, kAir_hu = -1000, kContrast_hu = 320;

/// How the phantom of an organ is made and named.
struct Kind {
    PhantomOrgan organ;
    double height_mm;
    double content_hu;
    const char *description, *body_part;
};
constexpr Kind kKinds[] = {{PhantomOrgan::airway, 280, kAir_hu, "CT CHEST", "CHEST"},
                           {PhantomOrgan::aorta, 400, kContrast_hu, "CT ANGIOGRAPHY", "AORTA"},
                           {PhantomOrgan::stomach, 280, kAir_hu, "CT ABDOMEN", "ABDOMEN"}};

const Kind& kindOf(const OrganPhantomOptions& options)
{
    for (const Kind& kind : kKinds)
        if (options.organ == kind.organ)
            return kind;
    throw Error(ErrorCode::wrong_use, "no organ of this kind", nameIn(kPhantomOrganNames, options.organ),
                "name airway, aorta or stomach");
}

Grid gridFor(const OrganPhantomOptions& options)
{
    const std::array<double, 3> extent_mm{kWidth_mm, kWidth_mm, kindOf(options).height_mm};
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

/// Distances to what is filled and to the outside of its wall, and what lies around.
struct OrganScene {
    FieldVolume organ_mm;   ///< of the organ alone
    FieldVolume filled_mm;  ///< of all that is filled as it is
    FieldVolume wall_mm;
    std::function<double(Point3 p, double filled_mm)> around_hu;
};

OrganScene sceneOfTubes(const Grid& grid, const SkeletonTree& tree, bool airway)
{
    FieldVolume lumen_mm = tubesField(grid, tree, 8);
    return {lumen_mm, lumen_mm, tubesField(grid, withWall(tree), 8),
            [airway](Point3 p, double inside_mm) { return airway ? chestHu(p) : trunkHu(p, inside_mm); }};
}

OrganScene sceneOfStomach(const Grid& grid, std::uint64_t seed)
{
    StomachGas gas = drawStomach(grid, seed);
    FieldVolume filled_mm = gas.stomach_mm;
    for (std::size_t n = 0; n < filled_mm.voxels.size(); ++n)
        filled_mm.voxels[n] = std::min(filled_mm.voxels[n], gas.other_mm.voxels[n]);
    FieldVolume wall_mm = filled_mm;
    for (float& mm : wall_mm.voxels)
        mm -= float(kStomachWall_mm);
    return {std::move(gas.stomach_mm), std::move(filled_mm), std::move(wall_mm),
            [](Point3 p, double) { return abdomenHu(p); }};
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
    const Kind& kind = kindOf(options);
    const Grid grid = gridFor(options);
    const bool airway = options.organ == PhantomOrgan::airway, stomach = options.organ == PhantomOrgan::stomach;
    OrganScan scan;
    if (!stomach)
        scan.truth.tree = airway ? drawAirway(options.seed) : drawAorta(options.seed);
    progress.report(0, "organ");
    const OrganScene organ = stomach ? sceneOfStomach(grid, options.seed) : sceneOfTubes(grid, scan.truth.tree, airway);
    progress.report(0.4, "body");
    const double voxel_mm = std::cbrt(grid.voxelVolume_mm3());
    scan.truth.inside = InsideVolume(grid);
    HuVolume scene(grid);
    for (std::size_t n = 0; n < scene.voxels.size(); ++n) {
        if (n % (1U << 20) == 0)
            progress.check();
        const double filled_mm = double(organ.filled_mm.voxels[n]);
        double hu = organ.around_hu(grid.pointAt(grid.indexOf(n)), filled_mm);
        hu += (kOrganWall_hu - hu) * share(double(organ.wall_mm.voxels[n]), voxel_mm);
        hu += (kind.content_hu - hu) * share(filled_mm, voxel_mm);
        scene.voxels[n] = std::int16_t(std::lround(hu));
        scan.truth.inside.voxels[n] = organ.organ_mm.voxels[n] < 0 ? kGas : kOutside;
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
    const std::string seed = std::to_string(options.seed), organ = nameIn(kPhantomOrganNames, options.organ);
    const auto& size = options.size;
    StudyHeader study;
    study.key = Random(options.seed,
                       organ + std::to_string(size[0]) + "x" + std::to_string(size[1]) + "x" + std::to_string(size[2]))
                    .bits();
    study.study_uid = uidFor(study.key, "study");
    study.patient_name = "Phantom^" + organ + seed;
    study.patient_id = "PHANTOM-" + organ + "-" + seed;
    study.birth_date = "19500115";
    study.sex = "F";
    study.date = "20240115";
    study.accession_number = "P" + seed;
    study.study_id = seed.substr(0, 16);
    const Kind& kind = kindOf(options);
    study.description = kind.description;
    study.body_part = kind.body_part;
    study.protocol = kind.body_part;
    const SeriesHeader series{2, uidFor(study.key, organ), organ + " soft", "HFS"};
    writeSeries(out / ("series-2-" + organ), study, series, scan.hu, progress);
    scan_files::writeVolume(out / ("truth-" + organ + "-inside.mha"), scan.truth.inside, scan_files::Packing::zlib);
    nlohmann::json truth = describe(scan.truth);
    truth["organ"] = organ;
    truth["scan"] = series.uid;
    truth["study"] = study.study_uid;
    truth["noise_hu"] = options.noise_hu;
    replaceFile(out / ("truth-" + organ + ".json"), truth.dump() + "\n");
    progress.report(1, "study");
}

}  // namespace vicon::phantom
