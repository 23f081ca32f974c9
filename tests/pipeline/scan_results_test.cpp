// The results that steps hand on, written beside the steps.
#include "scan_results.h"

#include <gtest/gtest.h>

#include <future>
#include <latch>

#include "vicon/support/support.h"

namespace vicon::pipeline {
namespace {

using support::TemporaryFolder;

/// Labels that pack badly, so that writing them takes a while.
InsideVolume restless(int side)
{
    InsideVolume volume;
    volume.grid.size = {side, side, side};
    std::uint32_t state = 1;
    for (int n = 0; n < side * side * side; ++n)
        volume.voxels.push_back(std::uint8_t((state = state * 1664525 + 1013904223) >> 24));
    return volume;
}

/// Found by the sanitizers: the mask went while the thread that publishes it waited for its writing.
TEST(ScanResults, AMaskIsKeptUntilItIsWrittenWhoeverWaitsForThat)
{
    const TemporaryFolder folder;
    const InsideVolume mask = restless(120);
    for (int n = 0; n < 8; ++n) {
        ScanResults results(folder.path(), folder.path() / "claim", Quantity::density);
        results.putMask(mask);
        std::latch begun(1);
        const auto publishing = std::async(std::launch::async, [&] {
            begun.count_down();
            results.finish({"mask.mha"});
        });
        begun.wait();
        results.dropMask();
        EXPECT_EQ(scan_files::readVolume<std::uint8_t>(results.target("mask.mha")).voxels, mask.voxels) << n;
        publishing.wait();
    }
}

}  // namespace
}  // namespace vicon::pipeline
