#pragma once

#include "vicon/steps/wall_densities.h"

namespace vicon::steps {

// Densities and sizes that several files of the segmentation share. Where no case is named, none is recorded: they come
// from anatomy and from the scanner's blur, and stood before there was a phantom to choose them on. chain_family_test
// holds them on phantoms that nothing was chosen on.

// No case recorded but where one is named; reasons: densities as scanners give them, sizes of anatomy. Half or double
// of kAir_hu, kBody_hu, kFat_hu or kBone_hu keeps the lumen of the three cases (CONTRIBUTING.md) to Dice 0.9997.

/// Gas, in HU, as scanners give it.
inline constexpr double kAir_hu = kUsualAir_hu;
/// Half-way between air and fat: what lies below is gas or lung, what lies above is body.
inline constexpr double kBody_hu = -400;
/// Fat around the bowel.
inline constexpr double kFat_hu = -100;
/// Means of several voxels above this are bone or contrast, not a collapsed bowel with some tag in it.
inline constexpr double kBone_hu = 250;

/// Where a collapsed bowel begins in the fat around it, on averaged voxels: half-way from fat to its wall.
inline double softFrom_hu(const WallDensities& densities)
{
    return (kFat_hu + densities.tissue_hu) / 2;
}

/// How wide the blurred edge of gas is, from -800 to -480 HU: 0.9 sigma of the point spread, and noise.
inline constexpr double kBlurredEdge_mm = 2.1;
/// Smaller components of gas are not taken for lumen, and smaller parts that a change leaves over are crumbs.
inline constexpr double kSpeck_ml = 0.05;
/// Area of lumen at the end of the scan above which it goes on beyond: a lumen of 6 mm.
inline constexpr double kLargestCut_mm2 = 30;
/// What is closed or cut at a narrow passage, beyond its own radius. Chosen on the phantoms with `ileum` that
/// ileum_cut.cpp names.
inline constexpr double kNeckMargin_mm = 1.5;
/// Voxels of outside kept around the result.
inline constexpr int kMargin_voxels = 2;

}  // namespace vicon::steps
