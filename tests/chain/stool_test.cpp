// Lumps of tagged stool in whole phantoms: what is taken out, and what is told. Nothing was chosen on these seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "vicon/phantom/phantom.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/tissue.h"

namespace vicon::test {
namespace {

constexpr std::uint64_t kFirstSeed = 351;
constexpr int kScans = 8;
constexpr double kLarge_mm = 8;

struct Lump {
    double diameter_mm = 0;
    bool airy = false;
    double share = 0;  ///< of it that is lumen
    bool told = false;
};

/// Whether a pool may lie around it.
bool isAtPool(const phantom::StoolLump& lump, const phantom::PhantomTruth& truth)
{
    const double lowest_mm = -dot(lump.position_mm - Point3{}, truth.gravity) - lump.diameter_mm / 2;
    return std::any_of(truth.pools.begin(), truth.pools.end(), [&](const phantom::FluidPool& pool) {
        return lump.station_mm > pool.from_mm - 10 && lump.station_mm < pool.to_mm + 10 && lowest_mm < pool.level_mm;
    });
}

double shareInLumen(const phantom::StoolLump& lump, const phantom::PhantomTruth& truth, const InsideVolume& lumen)
{
    int found = 0, all = 0;
    const double reach_mm = lump.diameter_mm / 2;
    for (double x = -reach_mm; x <= reach_mm; x += 0.5)
        for (double y = -reach_mm; y <= reach_mm; y += 0.5)
            for (double z = -reach_mm; z <= reach_mm; z += 0.5) {
                const Point3 p = lump.position_mm + Vector3{x, y, z};
                if (truth.inside.valueOr(truth.inside.grid.indexAt(p), kOutside) != kFluid)
                    continue;
                ++all;
                found += lumen.valueOr(lumen.grid.indexAt(p), kOutside) != kOutside ? 1 : 0;
            }
    return all ? double(found) / all : 0;
}

std::vector<Lump> lumpsOf(std::uint64_t seed)
{
    NoProgress quiet;
    const bool prone = seed % 2 == 0;
    phantom::PhantomScan scan =
        phantom::makeScan({.seed = seed, .gaps = 0, .stool = 20, .extras = false}, prone ? "HFP" : "HFS", quiet);
    const HuVolume volume = steps::resample(std::move(scan.hu), {}, quiet);
    const steps::Segmentation found = steps::segmentColon(volume, scan.truth.gravity, {}, quiet);
    const steps::TissueResult tissue = steps::findTissue(volume, found.inside, scan.truth.gravity, {},
                                                         found.measures.at("noise_hu").get<double>(), quiet);
    std::vector<Lump> lumps;
    for (const phantom::StoolLump& lump : scan.truth.stool) {
        if (isAtPool(lump, scan.truth))
            continue;
        const double near_mm = lump.diameter_mm / 2 + tissue.untrusted.mottled.block_mm;
        const bool told =
            std::any_of(tissue.untrusted.mottled.blocks_mm.begin(), tissue.untrusted.mottled.blocks_mm.end(),
                        [&](Point3 block) { return distance(block, lump.position_mm) < near_mm; });
        lumps.push_back({lump.diameter_mm, lump.airy, shareInLumen(lump, scan.truth, tissue.lumen), told});
    }
    return lumps;
}

struct Counts {
    int all = 0, taken_out = 0, told = 0;
};

Counts countsOf(const std::vector<Lump>& lumps, bool airy)
{
    Counts counts;
    for (const Lump& lump : lumps) {
        if (lump.airy != airy || lump.diameter_mm < kLarge_mm)
            continue;
        ++counts.all;
        counts.taken_out += lump.share >= 0.8 ? 1 : 0;
        counts.told += lump.told ? 1 : 0;
    }
    std::printf("%s, %.0f mm and more: %d; taken out to 80 %%: %d; told: %d\n", airy ? "with air" : "even", kLarge_mm,
                counts.all, counts.taken_out, counts.told);
    return counts;
}

TEST(StoolInPhantoms, IsTakenOutOrToldOnUnseenSeeds)
{
    std::vector<Lump> lumps;
    for (int n = 0; n < kScans; ++n) {
        const std::vector<Lump> more = lumpsOf(kFirstSeed + std::uint64_t(n));
        lumps.insert(lumps.end(), more.begin(), more.end());
    }
    const Counts even = countsOf(lumps, false);
    countsOf(lumps, true);
    ASSERT_GT(even.all, 20);
    EXPECT_GE(even.taken_out, 0.85 * even.all);
    EXPECT_GE(even.told, 0.95 * even.all);
}

}  // namespace
}  // namespace vicon::test
