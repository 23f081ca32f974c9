#include "vicon/steps/tissue.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "grid/allocate.h"
#include "grid/byte_rows.h"
#include "grid/run_labels.h"
#include "grid/sharp_kernel.h"
#include "grid/voxel_lists.h"
#include "tissue/edge_model.h"
#include "tissue/faint_walls.h"
#include "tissue/junctions.h"
#include "tissue/levels.h"
#include "tissue/lumen_of_tissue.h"
#include "tissue/mottled.h"
#include "tissue/near_mask.h"
#include "tissue/openings.h"
#include "tissue/other_bowel.h"
#include "tissue/sheets.h"
#include "tissue/smooth_along_wall.h"
#include "tissue/stool.h"
#include "tissue/stool_in_fluid.h"
#include "tissue/stool_walls.h"

namespace vicon::steps {
namespace {

// Of the scanner's blur, 0.7 mm on usual voxels. Held by tissue_test. Half and
// double of kTagged_voxels move the wall of ctc-prone by 0.0004 mm in the mean; the others move none.
/// Tagging changes the densities this far from its fluid: three sigma of the point spread.
constexpr int kTagged_voxels = 4;
/// Two sigma beyond the lumen a fiftieth of its contrast is left.
constexpr int kShining_voxels = 2;

/// @param near_fluid what is near fluid
std::vector<std::uint8_t> nearGasToo(const InsideVolume& inside, const std::vector<std::uint8_t>& near_fluid)
{
    auto near = nearMask(inside, kGas, kTagged_voxels);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, near.size(), 1 << 16), [&](const auto& part) {
        for (std::size_t n = part.begin(); n < part.end(); ++n)
            near[n] = near[n] && near_fluid[n] ? 1 : 0;
    });
    return near;
}

/// Marks what is near stool with 2: its density is not known as that of fluid is, for blur takes it from a film.
void markNearStool(std::vector<std::uint8_t>& near, const Stool& stool, const Grid& grid)
{
    for (const std::size_t n : stool.dense) {
        const Index3 v = grid.indexOf(n);
        const int first = std::max(0, v.i - kTagged_voxels), last = std::min(grid.size[0] - 1, v.i + kTagged_voxels);
        for (int k = std::max(0, v.k - kTagged_voxels); k <= std::min(grid.size[2] - 1, v.k + kTagged_voxels); ++k)
            for (int j = std::max(0, v.j - kTagged_voxels); j <= std::min(grid.size[1] - 1, v.j + kTagged_voxels); ++j)
                for (std::size_t m = grid.offset({first, j, k}); m <= grid.offset({last, j, k}); ++m)
                    near[m] = near[m] ? 2 : 0;
    }
}

/// The densities, and those of the fraction where the lumen's tagging is or shines: as far as that is from the lumen
/// nothing is bright by itself but other bowel and bone.
/// @param bright_hu denser things are bright
HuVolume cleanse(const Mixture& mixture, const InsideVolume& lumen, double bright_hu, const TissueVolume& tissue)
{
    const auto tagged = nearMask(lumen, kFluid, kTagged_voxels), beside = nearMask(lumen, kFluid, kShining_voxels);
    const auto [nx, ny, nz] = tissue.grid.size;
    auto cleansed = makeVolume<std::int16_t>(tissue.grid);
    tbb::parallel_for(0, nz, [&, nx = nx, ny = ny](int k) {
        for (int j = 0; j < ny; ++j) {
            const std::size_t begin = tissue.grid.offset({0, j, k});
            if (const std::int16_t* acquired = mixture.row(j, k))
                std::copy_n(acquired, nx, &cleansed.voxels[begin]);
            else
                for (int i = 0; i < nx; ++i)
                    cleansed.voxels[begin + std::size_t(i)] = mixture.acquired({i, j, k});
            const std::uint8_t* row = &tagged[begin];
            for (int i = firstOther(row, 0, nx, 0); i < nx; i = firstOther(row, i + 1, nx, 0)) {
                const std::size_t n = begin + std::size_t(i);
                const std::int16_t hu = cleansed.voxels[n];
                const bool is_beyond = lumen.voxels[n] == kOutside && (tissue.voxels[n] < kHalfTissue || !beside[n]);
                if (hu == kPaddingHu || (is_beyond && hu > bright_hu))
                    continue;
                const double clean_hu =
                    kUsualAir_hu + (kUsualTissue_hu - kUsualAir_hu) * double(tissue.voxels[n]) / double(kWhole);
                // Fat and what else is darker than tissue stays: only fluid makes brighter.
                if (lumen.voxels[n] == kFluid || hu > clean_hu)
                    cleansed.voxels[n] = std::int16_t(std::lround(clean_hu));
            }
        }
    });
    return cleansed;
}

/// As the levels have it, or a usual one.
double blurOf(const FluidLevels& levels, const DownAxis& down, const Grid& grid, const TissueOptions& options)
{
    return levels.fitted > 0 ? levels.sigma_voxels * grid.spacing_mm[std::size_t(down.axis)] : options.usual_blur_mm;
}

/// Tagging is brighter than tissue by this, and by so many times the noise that none of that is taken for it.
double brightOfStool_hu(double tissue_hu, double noise_hu, const TissueOptions& options)
{
    constexpr double kNoises = 3;  // standard deviations: one in 700 of normal noise is brighter
    return tissue_hu + std::max(options.tag_contrast_hu, kNoises * noise_hu);
}

/// What fills the lumen.
struct Contents {
    InsideVolume inside;  ///< with stool
    FluidLevels levels;
    Stool stool;
    double blur_mm = 0;
};

/// The stool, and the labels as fluid alone has them: stool has no level, however flat its top.
std::pair<Stool, InsideVolume> partStool(const Mixture& as_labelled, const DownAxis& down, double noise_hu,
                                         const TissueOptions& options)
{
    InsideVolume fluid = as_labelled.inside;
    if (!options.find_stool)
        return {Stool(), std::move(fluid)};
    const std::vector<std::size_t> in_fluid = stoolInFluid(as_labelled, down, options.usual_blur_mm);
    for (const std::size_t n : in_fluid)
        fluid.voxels[n] = kOutside;
    const Mixture mixture = as_labelled.with(fluid);
    Stool stool = findStool(mixture, brightOfStool_hu(mixture.tissue_hu, noise_hu, options), options.usual_blur_mm);
    leaveOnThinFolds(fluid, stool);
    keepWallsBehind(fluid, stool);
    stool.wall = without(stool.wall, in_fluid);
    for (const std::size_t n : without(without(in_fluid, stool.dense), stool.mixed))
        fluid.voxels[n] = kFluid;  // its level tells the wall under it better than a guess
    return {std::move(stool), std::move(fluid)};
}

Contents findContents(const Mixture& as_labelled, const DownAxis& down, double noise_hu, const TissueOptions& options)
{
    auto [stool, labels] = partStool(as_labelled, down, noise_hu, options);
    const Mixture mixture = as_labelled.with(labels);
    Contents contents;
    contents.levels =
        findLevels(mixture, FluidDensity(mixture, noise_hu, options.tag_contrast_hu), down, options.usual_blur_mm);
    contents.blur_mm = blurOf(contents.levels, down, labels.grid, options);
    labelStool(mixture, stool, labels);
    contents.inside = std::move(labels);
    contents.stool = std::move(stool);
    return contents;
}

/// No tissue where stool mixes with gas; and walls that stay.
void setBesideStool(const Mixture& mixture, const Stool& stool, TissueVolume& tissue)
{
    for (const std::size_t n : stool.mixed)
        tissue.voxels[n] = 0;
    for (const std::size_t n : stool.wall)
        tissue.voxels[n] = stored(mixture.fraction(mixture.hu(tissue.grid.indexOf(n)), mixture.gas_hu));
}

}  // namespace

TissueResult findTissue(const HuVolume& acquired_hu, const InsideVolume& labels, Vector3 gravity,
                        const WallDensities& densities, double noise_hu, Progress& progress,
                        const TissueOptions& options, const std::vector<Point3>& cuts_mm)
{
    progress.report(0, "tissue");
    // MR, which has no stool that could be told, has no such kernels.
    const auto soft = options.find_stool ? softened(acquired_hu, densities) : std::optional<SoftenedDensities>();
    const HuVolume& hu = soft ? soft->hu : acquired_hu;
    const DownAxis down(labels.grid, gravity);
    const Contents contents = findContents({hu, labels, densities}, down, noise_hu, options);
    const auto& [inside, levels, stool, blur_mm] = contents;
    const Mixture mixture(hu, inside, densities);
    const FluidDensity fluid(mixture, noise_hu, options.tag_contrast_hu);
    progress.check();
    progress.report(0.2, "tissue");
    const double blur_voxels = blur_mm / inside.grid.spacing_mm[std::size_t(down.axis)];
    TissueResult result;
    result.tissue = fractionAtEdges(mixture, fluid, down, blur_voxels);
    progress.check();
    progress.report(0.5, "tissue");
    setBesideStool(mixture, stool, result.tissue);
    const std::size_t in_levels = applyLevels(mixture, down, levels, noise_hu, result.tissue);
    auto near_both = nearGasToo(inside, nearMask(inside, kFluid, kTagged_voxels));
    markNearStool(near_both, stool, inside.grid);
    settleJunctions(mixture, fluid, down, near_both, blur_voxels, noise_hu, result.tissue);
    smoothAlongWall(near_both, result.tissue);
    const SheetsFound sheets = keepSheets(inside, stool, down, FractionNoise(mixture, fluid, noise_hu), result.tissue);
    setBesideStool(mixture, stool, result.tissue);  // what passes through the densities of tissue looks like a sheet
    progress.check();
    progress.report(0.8, "tissue");
    const RunLabels pieces = labelLumen(inside, Neighbours::faces);
    const std::vector<std::size_t> other_bowel =
        options.leave_out_other_bowel ? otherBowel(result.tissue, inside, pieces) : std::vector<std::size_t>{};
    result.lumen = lumenOf(result.tissue, inside, pieces, other_bowel);
    result.untrusted.mottled = findMottled(mixture, stool, noise_hu);
    std::vector<ClosedWall> closed =
        settleOpenings({mixture, pieces, other_bowel, cuts_mm}, result.tissue, result.lumen);
    std::ranges::move(closeFaintWalls(labels, stool, down, result.tissue, result.lumen), std::back_inserter(closed));
    reopenCuts(pieces, closed, result.tissue, result.lumen);
    for (const ClosedWall& each : closed)
        if (each.wall.area_mm2 > 0)  // else nothing of it is beside the lumen by now
            result.untrusted.faint.push_back(each.wall);
    result.cleansed = cleanse({acquired_hu, inside, densities}, result.lumen,
                              brightOfStool_hu(mixture.tissue_hu, noise_hu, options), result.tissue);
    result.blur_mm = blur_mm;
    result.found = {{"level_columns", levels.columns.size()},
                    {"level_columns_fitted", levels.fitted},
                    {"level_voxels", in_levels},
                    {"sheet_voxels", sheets.ridge_voxels},
                    {"faint_sheet_voxels", sheets.faint_voxels},
                    {"other_bowel_voxels", other_bowel.size()},
                    {"stool_lumps", stool.lumps},
                    {"stool_ml", double(stool.dense.size()) * inside.grid.voxelVolume_mm3() / 1000}};
    progress.report(1, "tissue");
    return result;
}

}  // namespace vicon::steps
