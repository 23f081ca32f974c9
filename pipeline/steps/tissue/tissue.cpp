#include "vicon/steps/tissue.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "grid/allocate.h"
#include "grid/byte_rows.h"
#include "grid/run_labels.h"
#include "tissue/edge_model.h"
#include "tissue/level_wall.h"
#include "tissue/levels.h"
#include "tissue/lumen_of_tissue.h"
#include "tissue/mottled.h"
#include "tissue/near_mask.h"
#include "tissue/other_bowel.h"
#include "tissue/sheets.h"
#include "tissue/smooth_along_wall.h"

namespace vicon::steps {
namespace {

// Of the scanner's blur, 0.7 mm on usual voxels. Held by tissue_test. Half and
// double of kTagged_voxels move the wall of ctc-prone by 0.0004 mm in the mean; the others move none.
/// Tagging changes the densities this far from its fluid: three sigma of the point spread.
constexpr int kTagged_voxels = 4;
/// Of the cleansed densities, as the field has them, whatever the options say of the wall: gas and tissue.
constexpr double kCleanGas_hu = -1000;
constexpr double kCleanTissue_hu = WallDensities().tissue_hu;

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

/// The densities, and those of the fraction where they are tagged.
HuVolume cleanse(const Mixture& mixture, const std::vector<std::uint8_t>& tagged, const TissueVolume& tissue)
{
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
                if (hu == kPaddingHu)
                    continue;
                const double clean_hu =
                    kCleanGas_hu + (kCleanTissue_hu - kCleanGas_hu) * double(tissue.voxels[n]) / double(kWhole);
                // Fat and what else is darker than tissue stays: only fluid makes brighter.
                if (mixture.inside.voxels[n] == kFluid || hu > clean_hu)
                    cleansed.voxels[n] = std::int16_t(std::lround(clean_hu));
            }
        }
    });
    return cleansed;
}

/// Sets the fraction in the levels' layers: column by column, and beside the wall along it.
/// @return the number of voxels
std::size_t modelLevels(const Mixture& mixture, const DownAxis& down, double noise_hu, const FluidLevels& levels,
                        TissueVolume& tissue)
{
    const LevelVoxels voxels(applyLevels(mixture, down, levels, noise_hu, tissue), tissue.grid, down);
    refineAtWall(mixture, down, levels, voxels, noise_hu, tissue);
    return voxels.size();
}

}  // namespace

TissueResult findTissue(const HuVolume& hu, const InsideVolume& inside, Vector3 gravity, const WallDensities& densities,
                        double noise_hu, Progress& progress, const TissueOptions& options)
{
    progress.report(0, "tissue");
    const Mixture mixture(hu, inside, densities);
    const DownAxis down(inside.grid, gravity);
    const FluidDensity fluid(mixture, noise_hu, options.tag_contrast_hu);
    const FluidLevels levels = findLevels(mixture, fluid, down, options.usual_blur_mm);
    progress.check();
    progress.report(0.2, "tissue");
    const double usual_voxels = options.usual_blur_mm / inside.grid.spacing_mm[std::size_t(down.axis)];
    const double blur_voxels = levels.fitted > 0 ? levels.sigma_voxels : usual_voxels;
    TissueResult result;
    result.tissue = fractionAtEdges(mixture, fluid, down, blur_voxels);
    progress.check();
    progress.report(0.5, "tissue");
    const std::size_t in_levels = modelLevels(mixture, down, noise_hu, levels, result.tissue);
    const auto near_fluid = nearMask(inside, kFluid, kTagged_voxels);
    smoothAlongWall(nearGasToo(inside, near_fluid), result.tissue);
    const SheetsFound sheets = keepSheets(inside, down, FractionNoise(mixture, fluid, noise_hu), result.tissue);
    progress.check();
    progress.report(0.8, "tissue");
    const RunLabels pieces = labelLumen(inside, Neighbours::faces);
    const std::vector<std::size_t> other_bowel =
        options.leave_out_other_bowel ? otherBowel(result.tissue, inside, pieces) : std::vector<std::size_t>{};
    result.lumen = lumenOf(result.tissue, inside, pieces, other_bowel);
    result.mottled = findMottled(mixture, noise_hu);
    result.cleansed = cleanse(mixture, near_fluid, result.tissue);
    result.blur_mm = blur_voxels * inside.grid.spacing_mm[std::size_t(down.axis)];
    result.found = {{"level_columns", levels.columns.size()},
                    {"level_columns_fitted", levels.fitted},
                    {"level_voxels", in_levels},
                    {"sheet_voxels", sheets.ridge_voxels},
                    {"faint_sheet_voxels", sheets.faint_voxels},
                    {"other_bowel_voxels", other_bowel.size()}};
    progress.report(1, "tissue");
    return result;
}

}  // namespace vicon::steps
