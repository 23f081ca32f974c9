#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "vicon/core/option_names.h"
#include "vicon/core/progress.h"
#include "vicon/core/skeleton_tree.h"
#include "vicon/core/volume.h"

namespace vicon::phantom {

/// What there is a phantom of.
enum class PhantomOrgan { colon, airway, aorta, stomach };
inline constexpr EnumNames<PhantomOrgan, 4> kPhantomOrganNames{{
    {PhantomOrgan::colon, "colon"},
    {PhantomOrgan::airway, "airway"},
    {PhantomOrgan::aorta, "aorta"},
    {PhantomOrgan::stomach, "stomach"},
}};
constexpr const auto& optionNames(PhantomOrgan /*value*/)
{
    return kPhantomOrganNames;
}

/// A chest with an airway tree, a trunk with an aorta or an upper abdomen with a stomach full of gas; see
/// docs/dev/organs.md. The same options give the same study.
struct OrganPhantomOptions {
    PhantomOrgan organ = PhantomOrgan::airway;  ///< not the colon; see PhantomOptions
    std::uint64_t seed = 1;
    std::array<int, 3> size{256, 256, 256};  ///< columns, rows, slices, over 300 x 300 x 280 mm (aorta: 400 high)
    double noise_hu = 20;
};

/// What an organ's scan shows, exactly.
struct OrganTruth {
    SkeletonTree tree;  ///< of a stomach none; axes as straight stretches with the tube's radius; a child begins at its
                        ///< parent's end
    InsideVolume inside;  ///< on the grid of the scan
};

struct OrganScan {
    HuVolume hu;  ///< supine, head first
    OrganTruth truth;
};

/// Throws Error{wrong_use} for the colon.
OrganScan makeOrganScan(const OrganPhantomOptions& options, Progress& progress);

/// Writes a study into the folder `out`, which is made and must be empty: a folder of DICOM files, and beside it
/// truth-ORGAN.json and truth-ORGAN-inside.mha. Throws also Error{store}.
void writeOrganStudy(const std::filesystem::path& out, const OrganPhantomOptions& options, Progress& progress);

}  // namespace vicon::phantom
