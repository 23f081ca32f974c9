// The lumen thinned to a graph: as coarse as it may be, as fine as it must be.
#include "grid/lumen_graph.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "grid/lumen_front.h"
#include "vicon/core/progress.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

constexpr int kCoarsest = 4;

/// Two rooms, joined by what is in the channel between them.
template <class InChannel>
LumenGraph graphOfTwoRooms(InChannel inChannel)
{
    InsideVolume inside(Grid{.size = {48, 20, 20}});
    for (std::size_t n = 0; n < inside.voxels.size(); ++n) {
        const Index3 v = inside.grid.indexOf(n);
        const bool in_room = std::min({v.i, v.j, v.k}) >= 2 && v.i < 46 && v.j < 18 && v.k < 18;
        const bool between = v.i >= 18 && v.i < 30;
        inside.voxels[n] = in_room && (!between || inChannel(v)) ? kGas : kOutside;
    }
    NoProgress quiet;
    return makeWholeGraph(wallDistance(inside, quiet), kCoarsest, quiet);
}

TEST(LumenGraph, IsCoarseWhereThatHoldsTogether)
{
    EXPECT_EQ(graphOfTwoRooms([](Index3 v) { return v.j >= 6 && v.j < 14; }).block, kCoarsest);
}

TEST(LumenGraph, IsAsFineAsAWindingChannelNeeds)
{
    // A voxel wide, up and down across the coarse blocks.
    const LumenGraph graph = graphOfTwoRooms([](Index3 v) {
        const int end = v.i / kCoarsest % 2 == 0 ? 4 : 15;
        return v.k == 9 && v.j >= 4 && v.j <= 15 && (v.i % kCoarsest == 0 || v.j == end);
    });
    EXPECT_LT(graph.block, kCoarsest);
    EXPECT_EQ(connectedSets(graph, std::vector<std::uint8_t>(graph.count(), 1)).size(), 1U);
}

TEST(LumenGraph, OfNothingIsEmpty)
{
    NoProgress quiet;
    EXPECT_EQ(makeWholeGraph(FieldVolume(Grid{.size = {8, 8, 8}}), kCoarsest, quiet).count(), 0U);
}

}  // namespace
}  // namespace vicon::steps
