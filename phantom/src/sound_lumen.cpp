#include "sound_lumen.h"

#include "paint.h"
#include "topology.h"
#include "vicon/core/error.h"

namespace vicon::phantom {
namespace {

bool hasTopology(const InsideVolume& inside, const LumenField& field, int euler_number)
{
    return eulerNumber26(inside, field.low, field.size) == euler_number &&
           eulerNumber6(inside, field.low, field.size) == euler_number;
}

/// Whether pieces are as many as they may be: a tunnel too many can hide a piece too many; a contact of loops may join
/// what a gap parts.
bool isSound(const InsideVolume& inside, const LumenField& field, const PhantomTruth& truth)
{
    if (!hasTopology(inside, field, truth.euler_number))
        return false;
    const int pieces = countPieces(inside);
    return pieces >= truth.euler_number && pieces <= int(truth.gaps.size()) + 1;
}

/// What is left once voxels that touch others by a corner alone are taken out may be mended by others that are put in:
/// between folds that touch one another so.
void mendAtCorners(InsideVolume inside, LumenField& field, int euler_number)
{
    for (const Index3 v : partAtCorners(inside, field.low, field.size, euler_number))
        field.lumen[field.offset(v)] = 0;
    for (const Index3 v : fillAtCorners(inside, field.low, field.size, euler_number))
        field.lumen[field.offset(v)] = -1;
}

}  // namespace

InsideVolume soundLumen(const Grid& grid, const Scene& scene, LumenField& field, const PhantomTruth& truth,
                        Progress& progress)
{
    constexpr int kRounds = 6;
    std::vector<std::int8_t> rounded_once;
    for (int round = 0; round < kRounds; ++round) {
        progress.check();
        // A polyp keeps its shape unless its foot is what the voxels cannot show.
        roundOff(field, grid, round < kRounds / 2 ? truth.polyps : std::vector<Polyp>());
        InsideVolume inside = labelLumen(grid, scene, field, truth);
        if (field.cropped)
            return inside;
        if (hasTopology(inside, field, truth.euler_number))
            return inside;
        if (round == 0)
            rounded_once = field.lumen;
        const std::vector<Index3> out = partAtCorners(inside, field.low, field.size, truth.euler_number);
        if (!isSound(inside, field, truth))
            continue;
        for (const Index3 v : out)
            field.lumen[field.offset(v)] = 0;
        return inside;
    }
    field.lumen = std::move(rounded_once);  // rounding off joins more and more where a wall is as thin as a voxel
    mendAtCorners(labelLumen(grid, scene, field, truth), field, truth.euler_number);
    InsideVolume inside = labelLumen(grid, scene, field, truth);
    if (isSound(inside, field, truth))
        return inside;
    throw Error(ErrorCode::internal, "the lumen of this seed joins loops or folds where it should not", {},
                "use another --seed, or smaller voxels (--size)");
}

}  // namespace vicon::phantom
