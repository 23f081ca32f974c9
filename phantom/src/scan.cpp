#include <algorithm>
#include <cmath>
#include <numbers>

#include "bubbles.h"
#include "grid.h"
#include "hips.h"
#include "ileum.h"
#include "imaging.h"
#include "lumen_field.h"
#include "magnetic.h"
#include "paint.h"
#include "pools.h"
#include "scene.h"
#include "slices.h"
#include "sound_lumen.h"
#include "stool.h"
#include "topology.h"
#include "vicon/core/error.h"
#include "wall.h"

namespace vicon::phantom {
namespace {

constexpr double kThinWall_mm = 1, kThinWallVoxels = 1.5;  // of tissue where loops almost touch
constexpr double kSeparation_mm = 5;  // between the lumens of two loops; more where voxels are coarse
constexpr double kOvershoot = 1.5;    // of a sharp kernel: an edge's eighth

Vector3 turned(Vector3 v, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return {v.x, c * v.y - s * v.z, s * v.y + c * v.z};
}

void checkOptions(const PhantomOptions& options)
{
    for (const OptionSpec& spec : specsOf<PhantomOptions>()) {
        const nlohmann::json value = toJson(options).at(spec.key);
        if (value.is_number() && (value.get<double>() < spec.lowest || value.get<double>() > spec.highest))
            throw Error(ErrorCode::wrong_use, spec.key + " is out of range", value.dump());
    }
}

double drawn(const PhantomOptions& options, const char* what, double low, double high)
{
    return Random(options.seed, what).uniform(low, high);
}

double blurOf(const PhantomOptions& options)
{
    if (options.blur_mm > 0)
        return options.blur_mm;
    switch (options.protocol.kernel) {
        case Kernel::smooth:
            return drawn(options, "blur", 0.8, 1.1);
        case Kernel::sharp:
            return drawn(options, "blur", 0.45, 0.6);
        case Kernel::usual:
            break;
    }
    return drawn(options, "blur", 0.5, 0.8);
}

double noiseOf(const PhantomOptions& options)
{
    if (options.noise_hu >= 0)
        return options.noise_hu;
    return options.low_dose ? drawn(options, "dose", 50, 80) : drawn(options, "dose", 15, 40);
}

/// The angle about the curve as a clock's: 0 at the front, growing clockwise as seen from the anal side.
double clockAngle(const CourseSample& at, Point3 p)
{
    const Vector3 front{0, -1, 0}, above{0, 0, 1};
    const bool along_front = std::abs(dot(at.tangent, front)) > 0.9;
    const Vector3 reference = along_front ? above : front;  // where the colon itself runs to the front: the head
    const Vector3 twelve = normalized(reference - at.tangent * dot(reference, at.tangent));
    const Vector3 d = p - at.position_mm;
    // Looking along the tangent, clockwise is from twelve towards tangent x twelve.
    const double angle = std::atan2(dot(d, cross(at.tangent, twelve)), dot(d, twelve)) * 180 / std::numbers::pi;
    return angle < 0 ? angle + 360 : angle;
}

/// Distance from the axis to the wall: the least over the angle.
double innerRadius_mm(const Wall& wall, double station_mm)
{
    double least = 1e9;
    for (int n = 0; n < 48; ++n)
        least = std::min(least, wall.at(station_mm, 2 * std::numbers::pi * n / 48).lumen_mm);
    return std::max(least, 0.0);
}

ColonPartRanges partsOf(const DrawnCourse& drawn)
{
    const auto stationOf = [&](double stop) {
        const auto n = std::size_t(stop);
        return std::lerp(drawn.stop_station_mm[n], drawn.stop_station_mm[n + 1], stop - double(n));
    };
    const WayMarks marks;
    const double splenic = stationOf(marks.splenic_corner), hepatic = stationOf(marks.hepatic_corner);
    const std::array<double, 9> bounds{0,
                                       stationOf(marks.sigmoid),
                                       stationOf(marks.descending),
                                       splenic - marks.flexure_mm,
                                       splenic + marks.flexure_mm,
                                       hepatic - marks.flexure_mm,
                                       hepatic + marks.flexure_mm,
                                       stationOf(marks.caecum),
                                       drawn.course.length_mm()};
    ColonPartRanges parts;
    for (std::size_t n = 0; n + 1 < bounds.size(); ++n)
        parts.push_back({ColonPart(n), bounds[n], bounds[n + 1]});
    return parts;
}

PhantomTruth describe(const DrawnCourse& drawn, const Wall& wall)
{
    PhantomTruth truth;
    truth.length_mm = drawn.course.length_mm();
    for (std::size_t n = 0; n < drawn.course.samples.size(); ++n) {
        const double station_mm = drawn.course.stationOf(n);
        truth.curve.push_back({drawn.course.samples[n].position_mm, station_mm, innerRadius_mm(wall, station_mm)});
        truth.wall_mm.push_back(drawn.warp.wallAt(station_mm));
    }
    truth.parts = partsOf(drawn);
    truth.polyps = wall.polyps;
    for (Polyp& polyp : truth.polyps)
        polyp.clock_deg = clockAngle(drawn.course.samples[drawn.course.sampleAt(polyp.station_mm)], polyp.position_mm);
    truth.gaps = wall.gaps;
    return truth;
}

void measure(PhantomTruth& truth)
{
    std::size_t gas = 0, fluid = 0;
    for (const std::uint8_t label : truth.inside.voxels) {
        gas += label == kGas;
        fluid += label == kFluid;
    }
    const double voxel_ml = truth.inside.grid.voxelVolume_mm3() / 1000;
    truth.volume_ml = double(gas + fluid) * voxel_ml;
    truth.fluid_ml = double(fluid) * voxel_ml;
}

/// What fills the lumen of a CT.
void drawContents(const PhantomOptions& options, const Course& course, const Wall& wall, Position position,
                  PhantomTruth& truth)
{
    if (options.mr != MrLumen::none)  // in MR all of the lumen is filled alike
        return;
    if (options.fluid)
        truth.pools = drawPools(options.seed, course, wall, position);
    if (options.protocol.tagging_hu > 0)
        for (FluidPool& pool : truth.pools)
            pool.density_hu = options.protocol.tagging_hu;
    truth.bubbles = drawBubbles(options, course, wall, truth.pools, position);
    truth.stool = drawStool(options, course, wall, position);
    truth.films = drawFilms(options, wall, position);
}

Scene surroundings(const PhantomOptions& options, const DrawnCourse& course, const Wall& wall, Position position,
                   PhantomTruth& truth)
{
    Scene scene = drawScene(options.seed, course, position,
                            {options.catheter, options.protocol.contrast, options.protocol.hips == Hips::metal});
    if (!options.ileum)
        return scene;
    Ileum ileum = drawIleum(options.seed, course, wall, truth.pools, position);
    for (Solid& solid : ileum.wall)
        solid.density_hu = scene.wall_hu;
    scene.ileum_wall = std::move(ileum.wall);
    scene.ileum_lumen = std::move(ileum.lumen);
    truth.ileum = ileum.truth;
    return scene;
}

/// What the scanner makes of a painted scene, whose slices it averages.
HuVolume scanned(const HuVolume& painted, const PhantomOptions& options, std::uint64_t seed, int thin_slices,
                 PhantomTruth& truth, Progress& progress)
{
    if (options.mr != MrLumen::none) {
        truth.noise_hu = 0;
        HuVolume hu = imageScene(signalScene(painted, truth.inside, options.mr == MrLumen::bright),
                                 {seed, truth.blur_mm, 0}, progress);
        receive(hu, options.seed, seed);
        return averagedSlices(std::move(hu), thin_slices);
    }
    ImagingOptions imaging{seed, truth.blur_mm, truth.noise_hu,
                           options.protocol.kernel == Kernel::sharp ? kOvershoot : 0};
    HuVolume hu;
    if (thin_slices == 1) {
        hu = imageScene(painted, imaging, progress);
    } else {
        imaging.noise_hu = 0;
        hu = averagedSlices(imageScene(painted, imaging, progress), thin_slices);
        imaging.noise_hu = truth.noise_hu;
        addTo(hu, imageScene(HuVolume(hu.grid, 0), imaging, progress));
    }
    if (options.protocol.hips != Hips::quiet)
        addHipArtefacts(hu, seed, progress);
    return hu;
}

}  // namespace

Grid scanGrid(const PhantomOptions& options, Placement placement)
{
    constexpr std::array<double, 3> kExtent_mm{kFieldMm, kFieldMm, kHeightMm};
    Grid grid;
    grid.size = options.size;
    for (std::size_t a = 0; a < 3; ++a)
        grid.spacing_mm[a] = options.spacing_mm[a] > 0 ? options.spacing_mm[a] : kExtent_mm[a] / options.size[a];
    const Vector3 down = gravityOf(placement.position), ahead{0, 0, placement.feet_first ? -1.0 : 1.0};
    const double oblique = options.oblique_deg * std::numbers::pi / 180;
    grid.axis = {turned(cross(down, ahead), oblique), turned(down, oblique), turned(ahead, oblique)};
    grid.origin_mm = Point3{0, 0, kHeightMm / 2};
    for (std::size_t a = 0; a < 3; ++a)
        grid.origin_mm += grid.axis[a] * -(grid.spacing_mm[a] * (grid.size[a] - 1) / 2);
    return grid;
}

PhantomScan makeScan(const PhantomOptions& options, const std::string& patient_position, Progress& progress)
{
    checkOptions(options);
    const Placement placement = placementFrom(patient_position);
    const auto [thin, thin_slices] = withThinSlices(options);
    const Grid grid = scanGrid(thin, placement);
    const double coarsest_mm = *std::max_element(grid.spacing_mm.begin(), grid.spacing_mm.end());

    progress.report(0, "course of the colon");
    const DrawnCourse course = drawCourse({.seed = options.seed,
                                           .position = placement.position,
                                           .separation_mm = std::max(kSeparation_mm, 2.5 * coarsest_mm),
                                           .thin_walls = options.thin_walls ? 3 : 0,
                                           .thin_wall_mm = std::max(kThinWall_mm, kThinWallVoxels * coarsest_mm),
                                           .self_contact = options.self_contact,
                                           .thinnest_fold_mm = 2 * coarsest_mm,
                                           .polyps = options.polyps,
                                           .stretch = options.stretch});
    const Wall wall = Wall::draw(options, course, placement.position, std::max(1.0, 0.75 * coarsest_mm));
    PhantomScan scan;
    scan.patient_position = patient_position;
    scan.truth = describe(course, wall);
    scan.truth.gravity = gravityOf(placement.position);
    drawContents(options, course.course, wall, placement.position, scan.truth);

    progress.report(0.1, "lumen");
    const Scene scene = surroundings(options, course, wall, placement.position, scan.truth);
    LumenField field = rasterise(grid, course.course, wall, scan.truth.pools, progress);
    scan.truth.euler_number = int(wall.gaps.size()) + 1 - (options.self_contact ? 1 : 0);
    scan.truth.inside = soundLumen(grid, scene, field, scan.truth, progress);
    measure(scan.truth);
    if (field.cropped)
        scan.truth.euler_number = eulerNumber26(scan.truth.inside, field.low, field.size);

    progress.report(0.5, "body");
    scan.truth.blur_mm = blurOf(options);
    scan.truth.noise_hu = noiseOf(options);
    const HuVolume painted = paintScene(grid, scene, field, scan.truth, progress);
    progress.report(0.7, "blur and noise");
    scan.hu = scanned(painted, options, options.seed * 8 + std::uint64_t(placement.position), thin_slices, scan.truth,
                      progress);
    progress.report(1, "scan");
    return scan;
}

std::vector<std::string> positionsOf(const PhantomOptions& options)
{
    const std::string head = options.feet_first ? "FF" : "HF";
    std::vector<std::string> positions;
    if (options.supine)
        positions.push_back(head + "S");
    if (options.prone)
        positions.push_back(head + "P");
    if (options.decubitus != Decubitus::none)
        positions.push_back(head + (options.decubitus == Decubitus::left ? "DL" : "DR"));
    return positions;
}

std::string nameOfPosition(const std::string& patient_position)
{
    switch (placementFrom(patient_position).position) {
        case Position::supine:
            return "supine";
        case Position::prone:
            return "prone";
        case Position::left:
            return "decubitus-left";
        case Position::right:
            return "decubitus-right";
    }
    throw Error(ErrorCode::internal, "no such position");
}

}  // namespace vicon::phantom
